"""The native format: JSON Lines, a header and then one line per scan, plain or gzip.

    {"format": "echorooms-log", "version": 1, "name": ..., "robot": {"radius": m}, "sonars": [...]}
    {"t": s, "odom": [x, y, heading], "ranges": [m or null, ...], "truth": [x, y, heading]}

`null` = no echo; NaN and Infinity are accepted as that. `truth` is optional. `stale` (optional) lists the
sonars whose value only repeats an earlier measurement; a log that has it anywhere is believed.
Fields that are not known are ignored. The same scan line is what a robot sends live.
"""

from __future__ import annotations

import json
from array import array
from collections.abc import Iterator
from typing import Any

import numpy as np

from core.errors import LogError, TooLargeError
from core.geometry import BoolArray
from core.log_readers.byte_source import ByteBudget, LogSource, numbered_lines, unpacked
from core.log_readers.draft_log import DraftLog, Finding
from core.log_readers.log_format import LogFormat
from core.log_readers.native_line import (
    FORMAT_NAME,
    NO_ECHO,
    ScanFields,
    header_of,
    parse_header,
    parse_scan,
    scan_fields,
)
from core.log_readers.native_writer import write_native
from core.progress import Progress
from core.sensing.ring import SonarRing

__all__ = ["FORMAT", "header_of", "parse_header", "parse_scan", "read_native", "write_native"]

PROGRESS_EVERY = 2000


def read_native(source: LogSource, ring: SonarRing | None, progress: Progress) -> DraftLog:
    """Reads a native log; a last line that was cut in the middle is left out.

    Raises:
        LogError: file and line, and what is wrong there.
        TooLargeError: beyond the limits.
    """
    size = max(source.path.stat().st_size, 1)
    budget = ByteBudget(source.limits, size)
    with source.path.open("rb") as raw:
        lines = numbered_lines(unpacked(raw), source.name, budget, source.limits)
        drive = _Drive(source, lines, ring)
        for count in drive.read():
            if count % PROGRESS_EVERY == 0:
                progress(min(raw.tell() / size, 1.0), "reading the log")
    return drive.draft()


FORMAT = LogFormat(
    FORMAT_NAME, lambda source: source.head.lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{", read_native
)


class _Drive:
    """The scans of a native log while they are read, in arrays that grow."""

    def __init__(
        self, source: LogSource, lines: Iterator[tuple[int, bytes]], ring: SonarRing | None
    ) -> None:
        self.source = source
        self.notes: list[Finding] = []
        self.skipped: list[Finding] = []
        self._lines = lines
        self._t, self._poses, self._ranges = array("d"), array("d"), array("d")
        self._numbers, self._truth = array("q"), array("d")
        self._stale: list[tuple[int, list[int]]] = []
        self._without_truth = 0
        self.name, self.ring = self._header(ring)

    def read(self) -> Iterator[int]:
        """Takes in the scans; yields how many so far, after each."""
        limit = self.source.limits.max_readings // len(self.ring)
        for number, line in self._lines:
            if line.isspace():
                continue
            record = self._json(number, line)
            if record is None:
                continue
            if len(self._t) >= limit:
                raise TooLargeError(
                    f"{self.source.name}, line {number}: more than {limit} scans of "
                    f"{len(self.ring)} sonars; split the drive into shorter logs"
                )
            try:
                self._take(number, scan_fields(record, len(self.ring), self.source.limits))
            except OverflowError:
                raise LogError("ranges: a number is too large", self.source.name, number) from None
            except LogError as error:
                raise LogError(str(error), self.source.name, number) from None
            yield len(self._t)

    def draft(self) -> DraftLog:
        """The log so far."""
        count = len(self._t)
        if not count:
            raise LogError("the log has a header but no scans", self.source.name)
        notes = list(self.notes)
        if self._truth and self._without_truth:
            notes.append(Finding("scans without truth; the truth is not used", self._without_truth))
        shape = (count, len(self.ring))
        return DraftLog(
            FORMAT_NAME,
            self.name,
            self.ring,
            np.array(self._t),
            np.array(self._poses).reshape(count, 3),
            np.array(self._ranges).reshape(shape),
            np.array(self._numbers),
            self.source.name,
            self._fresh(shape),
            None if self._without_truth else np.array(self._truth).reshape(count, 3),
            tuple(self.skipped),
            tuple(notes),
        )

    def _header(self, ring: SonarRing | None) -> tuple[str, SonarRing]:
        number, line = next(((n, x) for n, x in self._lines if not x.isspace()), (1, b""))
        header = self._json(number, line, first=True)
        try:
            name, own_ring = parse_header(header, ring, self.source.limits)
        except LogError as error:
            raise LogError(str(error), self.source.name, number) from None
        except TooLargeError as error:
            raise TooLargeError(f"{self.source.name}, line {number}: {error}") from None
        if ring is not None and own_ring != ring:
            self.notes.append(Finding("ring given, but the log's own is used", 1))
        return name or self.source.path.name.split(".")[0], own_ring

    def _json(self, number: int, line: bytes, first: bool = False) -> Any:
        """The object of a line, or None for a last line that was cut."""
        try:
            return json.loads(line.decode("utf-8-sig" if first else "utf-8"))
        except RecursionError:
            reason = "nested too deep"
        except UnicodeDecodeError:
            reason = "not UTF-8 text"
        except json.JSONDecodeError as error:
            reason = f"{error.msg} at column {error.colno}"
        except ValueError:
            reason = "a number with too many digits"
        if not first and not line.endswith(b"\n"):
            self.skipped.append(Finding.at("last line cut in the middle", [number]))
            return None
        raise LogError(f"not a line of JSON ({reason})", self.source.name, number)

    def _take(self, number: int, fields: ScanFields) -> None:
        t, odometry, ranges, truth, stale = fields
        self._ranges.extend([NO_ECHO if r is None else r for r in ranges])
        if stale is not None:
            self._stale.append((len(self._t), stale))
        self._t.append(t)
        self._poses.extend(odometry)
        self._numbers.append(number)
        if truth is None:
            self._without_truth += 1
        else:
            self._truth.extend(truth)

    def _fresh(self, shape: tuple[int, int]) -> BoolArray | None:
        if not self._stale:
            return None
        fresh = np.ones(shape, bool)
        for scan, sonars in self._stale:
            fresh[scan, sonars] = False
        return fresh
