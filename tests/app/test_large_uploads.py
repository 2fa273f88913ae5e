"""Uploads that are too much: refused in seconds, within little memory, and heard by the sender."""

from __future__ import annotations

import gzip
import json
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import psutil

PEAK_BYTES = 1_000_000_000
MANY = 200_000
UPLOAD_LIMIT_MB = 64


class PeakMemory:
    """The largest memory of a process and its children together, looked at every 20 ms."""

    def __init__(self, pid: int) -> None:
        self.bytes = 0
        self._process = psutil.Process(pid)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._watch)

    def __enter__(self) -> PeakMemory:
        self._thread.start()
        return self

    def __exit__(self, *error: object) -> None:
        self._stop.set()
        self._thread.join()

    def _watch(self) -> None:
        while not self._stop.wait(0.02):
            total = 0
            for process in (self._process, *self._process.children(recursive=True)):
                try:
                    total += process.memory_info().rss
                except psutil.NoSuchProcess:
                    continue
            self.bytes = max(self.bytes, total)


def hostile(log: bytes) -> Iterator[tuple[str, bytes, set[int]]]:
    """Uploads that ask for much, with the answers that are allowed."""
    header = log.splitlines(keepends=True)[0]
    sonars = json.loads(header)
    sonars["sonars"] = [sonars["sonars"][0]] * MANY
    yield "200,000 sonars", json.dumps(sonars).encode() + b"\n", {413}
    yield (
        "a gzip of gigabytes",
        gzip.compress(header) + gzip.compress(b" " * 10_000_000) * 300,
        {413},
    )
    yield "a zip of zeros", b"PK\x03\x04" + bytes(50_000_000), {413, 422}
    yield "more than the limit", bytes(UPLOAD_LIMIT_MB + 8 << 20), {413}


def test_hostile_uploads_are_refused_in_seconds_under_a_gigabyte(
    start_server: Callable[..., Any], make_log: Callable[..., bytes]
) -> None:
    server = start_server(max_upload_mb=UPLOAD_LIMIT_MB)
    with PeakMemory(server.process.pid) as peak:
        for name, content, allowed in hostile(make_log()):
            started = time.monotonic()
            answer = server.http.post(
                "/api/logs", files={"file": ("drive.jsonl", content)}, timeout=60
            )
            assert answer.status_code in allowed, (name, answer.text)
            assert len(answer.json()["detail"].splitlines()) == 1, name
            assert time.monotonic() - started < 40, name
            assert server.http.get("/api/health").status_code == 200, name
    assert 0 < peak.bytes < PEAK_BYTES
    assert list((server.data / "temp").iterdir()) == []
    assert list((server.data / "logs").iterdir()) == []
