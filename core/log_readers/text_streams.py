"""A table of numbers as poses and ranges in SI units, in order of time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.errors import LogError
from core.geometry import AnyArray, BoolArray, FloatArray, IntArray
from core.log_readers.clock import ordered_time
from core.log_readers.draft_log import Finding
from core.log_readers.limits import ReadLimits
from core.log_readers.text_description import TextFile
from core.log_readers.text_table import TextTable
from core.wording import counted


@dataclass(frozen=True)
class FileStreams:
    """What one file tells, row by row.

    Attributes:
        source: the file as the user knows it.
        lines: (N,) 1-based.
        t: (N,) seconds, increasing.
        poses: (N, 3) odometry, if it is in this file.
        truth: (N, 3) true poses, if they are.
        sonars: (K,) which sonars `ranges` (N, K) are of; K may be 0.
        ranges: metres, NaN = no echo.
        too_close: (N, K) where a sonar said that something is nearer than it can measure.
        clock: what was wrong with the times.
        skipped: rows left out.
    """

    source: str
    lines: IntArray
    t: FloatArray
    poses: FloatArray | None
    truth: FloatArray | None
    sonars: IntArray
    ranges: FloatArray
    too_close: BoolArray
    clock: tuple[Finding, ...]
    skipped: tuple[Finding, ...]


def streams_of(
    table: TextTable, file: TextFile, source: str, ring_size: int, limits: ReadLimits
) -> FileStreams:
    """Converts units and sentinels, checks bounds, puts the rows in order of time.

    Raises:
        LogError: a time or pose that is blank, no number or out of bounds, at its line.
    """
    t = table.values[:, 0] * file.units.second
    _check(np.abs(t) <= limits.max_time_s, "no time in its column", table, source)
    place = 1
    poses = truth = None
    if file.columns.x is not None:
        poses, place = _poses(table, place, "pose", file, source, limits), place + 3
    if file.columns.truth_x is not None:
        truth, place = _poses(table, place, "true pose", file, source, limits), place + 3
    raw = table.values[:, place:]
    time = ordered_time(t, table.lines, source)
    keep = time.keep
    return FileStreams(
        source,
        table.lines[keep],
        time.t[keep] + file.time_offset,
        None if poses is None else poses[keep],
        None if truth is None else truth[keep],
        _sonars(file, ring_size, source),
        _ranges(raw, file)[keep],
        np.isin(raw, file.too_close)[keep],
        time.changes,
        (*table.skipped, *time.skipped),
    )


def _poses(
    table: TextTable, place: int, what: str, file: TextFile, source: str, limits: ReadLimits
) -> FloatArray:
    poses = table.values[:, place : place + 3].copy()
    poses[:, :2] *= file.units.position_metre
    poses[:, 2] *= file.units.radian
    near = np.abs(poses[:, :2]).max(axis=1) <= limits.max_coordinate_m
    kilometres = limits.max_coordinate_m / 1000
    _check(near, f"{what} missing or not within {kilometres:g} km (units?)", table, source)
    sane = np.abs(poses[:, 2]) <= limits.max_heading_rad
    _check(sane, f"heading of the {what} missing or no angle", table, source)
    return poses


def _check(good: AnyArray, what: str, table: TextTable, source: str) -> None:
    bad = np.flatnonzero(~good)
    if len(bad):
        raise LogError(what, source, int(table.lines[bad[0]]))


def _sonars(file: TextFile, ring_size: int, source: str) -> IntArray:
    count = len(file.columns.ranges)
    if file.sonars is None:
        if count not in (0, ring_size):
            raise LogError(
                f"{counted(count, 'column')} of ranges for a ring of {counted(ring_size, 'sonar')}; "
                "`sonars` says which",
                source,
            )
        return np.arange(count)
    sonars = np.array(file.sonars, np.int64)
    if len(sonars) != count or len(set(file.sonars)) != count:
        raise LogError(f"`sonars` must name one sonar for each of {count} columns", source)
    if count and sonars.max() >= ring_size:
        raise LogError(f"sonar {sonars.max()} in a ring of {ring_size} (the first is 0)", source)
    return sonars


def _ranges(raw: FloatArray, file: TextFile) -> FloatArray:
    silent = ~np.isfinite(raw) | np.isin(raw, [*file.no_echo, *file.too_close])
    if file.no_echo_from is not None:
        silent |= raw >= file.no_echo_from
    return np.where(silent, np.nan, raw * file.units.range_metre)
