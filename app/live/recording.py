"""The recording of a live session: a native log that grows by whole lines, safe on the disk."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from core.log_readers.native import parse_header


class Recording:
    """`log.jsonl` of a session: the header, then one line per scan. One writer at a time."""

    def __init__(self, path: Path) -> None:
        """Opens a recording; what a crash cut in the middle is removed, it was never confirmed."""
        self.path = path
        self.last_t: float | None = None
        self.stored = 0
        self.distance_m = 0.0
        self._last_xy: tuple[float, float] | None = None
        whole = 0
        with path.open("rb") as file:
            header = file.readline()
            whole += len(header)
            self.header: dict[str, Any] = json.loads(header)
            self.name, self.ring = parse_header(self.header)
            for line in file:
                if not line.endswith(b"\n"):
                    break
                whole += len(line)
                self._count(json.loads(line))
        self._size = whole
        if whole < path.stat().st_size:
            os.truncate(path, whole)

    @classmethod
    def create(cls, path: Path, header: dict[str, Any]) -> Recording:
        """A new recording, on the disk when this returns.

        Raises:
            LogError, TooLargeError: the header is none.
        """
        parse_header(header)
        line = json.dumps(header) + "\n"
        with path.open("xb") as file:
            file.write(line.encode())
            file.flush()
            os.fsync(file.fileno())
        return cls(path)

    @property
    def size(self) -> int:
        """Bytes that are safe: whole lines."""
        return self._size

    def append(self, records: Sequence[dict[str, Any]]) -> None:
        """Adds scans, all of them safe on the disk when this returns, or none.

        Raises:
            OSError: they could not be written; the recording is as before.
        """
        data = b"".join(_line(record) for record in records)
        try:
            with self.path.open("ab") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
        except OSError:
            os.truncate(self.path, self._size)
            raise
        self._size += len(data)
        for record in records:
            self._count(record)

    def so_far(self) -> bytes:
        """The whole lines that are safe. Reads the disk: call it in a thread."""
        with self.path.open("rb") as file:
            return file.read(self._size)

    def _count(self, record: dict[str, Any]) -> None:
        self.stored += 1
        self.last_t = float(record["t"])
        x, y = record["odom"][:2]
        if self._last_xy is not None:
            self.distance_m += ((x - self._last_xy[0]) ** 2 + (y - self._last_xy[1]) ** 2) ** 0.5
        self._last_xy = (x, y)


def _line(record: dict[str, Any]) -> bytes:
    return json.dumps(record, separators=(",", ":")).encode() + b"\n"
