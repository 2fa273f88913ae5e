"""A server that is killed loses nothing that it has confirmed, and leaves nothing half-written."""

from __future__ import annotations

import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest

SERVER = """
import sys
from pathlib import Path
from app.serve import run
from app.settings import Settings
run(Settings(data=Path(sys.argv[1]), port=0, warm_workers=1), lambda url: print(url, flush=True))
"""


class Server:
    """A server in a process of its own."""

    def __init__(self, data: Path) -> None:
        self.data = data
        self.process = subprocess.Popen(
            [sys.executable, "-c", SERVER, str(data)], stdout=subprocess.PIPE, text=True
        )
        assert self.process.stdout is not None
        self.url = self.process.stdout.readline().strip()
        self.http = httpx.Client(base_url=self.url, timeout=30)

    def upload(self, content: bytes) -> dict[str, Any]:
        answer = self.http.post("/api/logs", files={"file": ("drive.jsonl", content)})
        assert answer.status_code == 201, answer.text
        log: dict[str, Any] = answer.json()
        return log

    def kill(self) -> None:
        """Ends it as a power cut would."""
        self.process.kill()
        self.process.wait()
        self.http.close()

    def stop(self) -> float:
        """Ends it as Ctrl-C would; returns how long that took in seconds."""
        started = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        self.process.wait(timeout=20)
        return time.monotonic() - started


StartServer = Callable[[], Server]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[StartServer]:
    """Starts servers, one after another, on one data folder."""
    servers: list[Server] = []

    def begin() -> Server:
        servers.append(Server(tmp_path / "data"))
        return servers[-1]

    yield begin
    for server in servers:
        if server.process.poll() is None:
            server.kill()


def files_below(folder: Path) -> list[str]:
    return sorted(str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file())


def test_an_upload_that_dies_half_way_leaves_nothing(
    start: StartServer, make_log: Callable[..., bytes]
) -> None:
    server = start()
    server.upload(make_log(name="kept"))
    port = int(server.url.rstrip("/").rsplit(":", 1)[1])
    with socket.create_connection(("127.0.0.1", port)) as half:
        body = b'--b\r\nContent-Disposition: form-data; name="file"; filename="a.jsonl"\r\n\r\n'
        head = (
            "POST /api/logs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9000000\r\n"
            "Content-Type: multipart/form-data; boundary=b\r\n\r\n"
        )
        half.sendall(head.encode() + body + b"x" * 3_000_000)
        deadline = time.monotonic() + 10
        while not any("a.jsonl" in name for name in files_below(server.data / "temp")):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        server.kill()
    again = start()
    assert files_below(again.data / "temp") == []
    (log,) = again.http.get("/api/logs").json()
    assert log["name"] == "kept"
    assert len(list((again.data / "logs").iterdir())) == 1


def test_a_client_that_goes_away_in_mid_upload_leaves_nothing(start: StartServer) -> None:
    server = start()
    port = int(server.url.rstrip("/").rsplit(":", 1)[1])
    with socket.create_connection(("127.0.0.1", port)) as half:
        head = (
            "POST /api/logs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9000000\r\n"
            "Content-Type: multipart/form-data; boundary=b\r\n\r\n--b\r\n"
        )
        half.sendall(head.encode())
        time.sleep(0.2)
    deadline = time.monotonic() + 10
    while list((server.data / "temp").iterdir()):
        assert time.monotonic() < deadline
        time.sleep(0.02)
    assert server.http.get("/api/health").status_code == 200


def test_killed_in_the_middle_of_a_job_it_keeps_the_rest_and_says_why_the_job_failed(
    start: StartServer, make_log: Callable[..., bytes]
) -> None:
    server = start()
    small, large = server.upload(make_log()), server.upload(make_log(scans=20_000))
    done = server.http.post("/api/models", json={"log_id": small["id"], "regions": 2}).json()
    _wait(server, done["job_id"])
    node = server.http.get(f"/api/models/{done['id']}").json()["nodes"][0]["id"]
    server.http.patch(f"/api/models/{done['id']}/nodes/{node}", json={"label": "kitchen"})
    before = server.http.get(f"/api/models/{done['id']}").json()
    cut = server.http.post("/api/models", json={"log_id": large["id"], "regions": 2}).json()
    deadline = time.monotonic() + 30
    while server.http.get(f"/api/jobs/{cut['job_id']}").json()["progress"] < 0.06:
        assert time.monotonic() < deadline
        time.sleep(0.05)
    workers = psutil.Process(server.process.pid).children()
    assert workers
    server.kill()
    _, alive = psutil.wait_procs(workers, timeout=20)
    assert alive == []

    again = start()
    assert again.http.get(f"/api/models/{done['id']}").json() == before
    job = again.http.get(f"/api/jobs/{cut['job_id']}").json()
    model = again.http.get(f"/api/models/{cut['id']}").json()
    assert job["status"] == model["status"] == "failed"
    assert "stopped" in job["error"]
    assert model["error"] == job["error"]
    assert files_below(again.data / "temp") == []
    assert [p.name for p in (again.data / "models").iterdir()] == [done["id"]]


def test_ctrl_c_ends_it_soon_even_while_somebody_follows_a_job(
    start: StartServer, make_log: Callable[..., bytes]
) -> None:
    server = start()
    log = server.upload(make_log(scans=20_000))
    job_id = server.http.post("/api/models", json={"log_id": log["id"], "regions": 2}).json()[
        "job_id"
    ]
    with server.http.stream("GET", f"/api/jobs/{job_id}/events") as stream:
        lines = stream.iter_lines()
        next(lines)
        took = server.stop()
        last = [line for line in lines if line][-1]
    server.http.close()
    assert took < 5
    assert '"failed"' in last
    assert server.process.returncode == 0


def test_a_data_folder_serves_one_server_at_a_time(start: StartServer) -> None:
    server = start()
    second = subprocess.run(
        [sys.executable, "-c", SERVER, str(server.data)], capture_output=True, text=True, timeout=30
    )
    assert second.returncode != 0
    assert "in use by another EchoRooms server" in second.stderr.splitlines()[-1]


def _wait(server: Server, job_id: str) -> None:
    deadline = time.monotonic() + 60
    while server.http.get(f"/api/jobs/{job_id}").json()["status"] in ("queued", "running"):
        assert time.monotonic() < deadline
        time.sleep(0.05)
