"""Writes native logs."""

from __future__ import annotations

import gzip
import json
from collections.abc import Iterator
from pathlib import Path

from core.log_readers.native_line import header_of, scan_record
from core.sensing.robot_log import RobotLog

GZIP_LEVEL = 6


def write_native(log: RobotLog, path: Path) -> None:
    """Writes a native log, as gzip where the name ends in `.gz`; it is there whole or not at all.

    The same log gives the same bytes.
    """
    partial = path.with_name(path.name + ".partial")
    try:
        with partial.open("wb") as raw:
            if path.suffix == ".gz":
                with gzip.GzipFile("", "wb", GZIP_LEVEL, raw, mtime=0) as packed:
                    packed.writelines(_lines(log))
            else:
                raw.writelines(_lines(log))
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def _lines(log: RobotLog) -> Iterator[bytes]:
    yield json.dumps(header_of(log), allow_nan=False).encode() + b"\n"
    for i, scan in enumerate(log):
        record = scan_record(scan, None if log.truth is None else log.truth[i])
        yield json.dumps(record, allow_nan=False, separators=(",", ":")).encode() + b"\n"
