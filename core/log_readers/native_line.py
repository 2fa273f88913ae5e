"""One line of the native format: the header, or a scan as logs and live robots write it."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from core.errors import LogError
from core.geometry import AnyArray
from core.log_readers.limits import DEFAULT_LIMITS, ReadLimits
from core.log_readers.range_check import usable_ranges
from core.log_readers.ring_file import parse_ring, table_of
from core.sensing.ring import SonarRing
from core.sensing.robot_log import RobotLog, Scan
from core.wording import counted

FORMAT_NAME = "echorooms-log"
VERSION = 1
TIME_DECIMALS = 4
POSITION_DECIMALS = 4
HEADING_DECIMALS = 5
RANGE_DECIMALS = 3
NO_ECHO = float("nan")
_NUMBERS = frozenset((float, int))
_RANGES = frozenset((float, int, type(None)))

ScanFields = tuple[float, list[float], list[float | None], list[float] | None, list[int] | None]
"""t, odom, ranges, truth, stale as they stand in a line, checked."""


def parse_header(
    header: Any, ring: SonarRing | None = None, limits: ReadLimits = DEFAULT_LIMITS
) -> tuple[str, SonarRing]:
    """Name and ring of a native header; `ring` serves where the header has no sonars.

    Raises:
        LogError: it is no header; the error has no source.
        TooLargeError: too many sonars.
    """
    if not isinstance(header, dict) or header.get("format") != FORMAT_NAME:
        raise LogError(
            f'the first line must be a header with "format": "{FORMAT_NAME}" and the sonars'
        )
    version = header.get("version")
    if version != VERSION or isinstance(version, bool):
        raise LogError(f"version {json.dumps(version)[:20]} is not known; this program reads 1")
    name = header.get("name", "")
    if not isinstance(name, str):
        raise LogError("name must be text")
    name = " ".join("".join(c if c.isprintable() else " " for c in name).split())
    if ring is None or "sonars" in header:
        ring = parse_ring(header, limits)
    return name[: limits.max_name_length], ring


def header_of(log: RobotLog) -> dict[str, Any]:
    """The header that `parse_header` reads as the name and ring of `log`."""
    return {"format": FORMAT_NAME, "version": VERSION, "name": log.name, **table_of(log.ring)}


def parse_scan(record: Any, ring: SonarRing, limits: ReadLimits = DEFAULT_LIMITS) -> Scan:
    """One scan line, as a robot sends it; impossible ranges count as no echo.

    Raises:
        LogError: a field is missing or wrong; the error has no source.
    """
    t, odometry, ranges, _, stale = scan_fields(record, len(ring), limits)
    fresh = np.ones(len(ring), bool)
    fresh[stale or []] = False
    try:
        values = np.array([NO_ECHO if r is None else r for r in ranges], float)
    except OverflowError as error:
        raise LogError("ranges: a number is too large") from error
    return Scan(t, np.array(odometry, float), usable_ranges(values, ring), fresh)


def scan_record(scan: Scan, truth: AnyArray | None = None) -> dict[str, Any]:
    """A scan as the native format and the live protocol write it.

    Times are rounded to 0.1 ms, positions to 0.1 mm, ranges to mm, headings to 1e-5 rad.
    """
    record: dict[str, Any] = {
        "t": round(scan.t, TIME_DECIMALS),
        "odom": _rounded(scan.odometry),
        "ranges": [None if r != r else round(r, RANGE_DECIMALS) for r in scan.ranges.tolist()],
    }
    if truth is not None:
        record["truth"] = _rounded(truth)
    if not scan.fresh.all():
        record["stale"] = np.flatnonzero(~scan.fresh).tolist()
    return record


def scan_fields(record: Any, sonars: int, limits: ReadLimits) -> ScanFields:
    """The checked fields of a scan line."""
    if not isinstance(record, dict):
        raise LogError("a scan is an object with t, odom and ranges")
    t = record.get("t")
    if type(t) not in _NUMBERS or not -limits.max_time_s <= t <= limits.max_time_s:  # type: ignore[operator]
        raise LogError(f"t must be a time in seconds, not {_shown(t)}")
    odometry = _pose(record.get("odom"), "odom", limits)
    ranges = record.get("ranges")
    if not isinstance(ranges, list):
        raise LogError(f"ranges must be a list of {sonars} numbers or null, not {_shown(ranges)}")
    if len(ranges) != sonars:
        raise LogError(f"{counted(len(ranges), 'range')} for {counted(sonars, 'sonar')}")
    if not _RANGES.issuperset(map(type, ranges)):
        raise LogError("ranges must be numbers or null")
    truth = record.get("truth")
    if truth is not None:
        truth = _pose(truth, "truth", limits)
    stale = record.get("stale")
    if stale is not None and not (
        isinstance(stale, list) and all(type(i) is int and 0 <= i < sonars for i in stale)
    ):
        raise LogError(f"stale must be a list of sonar numbers from 0 to {sonars - 1}")
    return float(t), odometry, ranges, truth, stale  # type: ignore[arg-type]


def _pose(value: Any, what: str, limits: ReadLimits) -> list[float]:
    if not isinstance(value, list) or len(value) != 3 or not _NUMBERS.issuperset(map(type, value)):
        raise LogError(f"{what} must be [x, y, heading], not {_shown(value)}")
    bound, turn = limits.max_coordinate_m, limits.max_heading_rad
    x, y, heading = value
    if not (-bound <= x <= bound and -bound <= y <= bound):
        raise LogError(
            f"{what} {_shown(value)} is not within {bound / 1000:g} km of the origin (metres?)"
        )
    if not -turn <= heading <= turn:
        raise LogError(f"{what}: heading {_shown(heading)} is no angle in radians")
    return value


def _shown(value: Any) -> str:
    """A value as it may stand in a message."""
    try:
        text = json.dumps(value)
    except (ValueError, RecursionError):
        return "a number with too many digits"
    return text if len(text) <= 60 else text[:57] + "..."


def _rounded(pose: AnyArray) -> list[float]:
    x, y, heading = pose.tolist()
    return [
        round(x, POSITION_DECIMALS),
        round(y, POSITION_DECIMALS),
        round(heading, HEADING_DECIMALS),
    ]
