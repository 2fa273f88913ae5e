"""From a draft to a log: time put in order, impossible ranges removed, latched values found."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from core.log_readers.draft_log import DraftLog, Finding
from core.log_readers.drive_statistics import (
    DriveConfig,
    drive_statistics,
    largest_jumps,
    longest_gaps,
)
from core.log_readers.loaded_log import LoadedLog
from core.log_readers.log_report import LogReport
from core.log_readers.range_check import impossible, usable_ranges
from core.sensing.robot_log import RobotLog


@dataclass(frozen=True)
class AcceptanceConfig:
    """Settings of the checks."""

    drive: DriveConfig = field(default_factory=DriveConfig)


def accept(draft: DraftLog, config: AcceptanceConfig = AcceptanceConfig()) -> LoadedLog:
    """The log that a draft becomes, and its report.

    Raises:
        LogError: the times make no sense.
    """
    notes = list(draft.notes)
    wrong = impossible(draft.ranges, draft.ring)
    if wrong.any():
        rows = np.flatnonzero(wrong.any(axis=1))
        notes.append(
            Finding(
                "ranges that are zero, negative or beyond the sonar's range, taken as no echo",
                int(wrong.sum()),
                Finding.at("", draft.lines[rows].tolist()).lines,
                draft.source,
            )
        )
    ranges = usable_ranges(draft.ranges, draft.ring)
    fresh = np.ones(ranges.shape, bool) if draft.fresh is None else draft.fresh
    log = RobotLog(draft.name, draft.ring, draft.t, draft.odometry, ranges, fresh, draft.truth)
    return LoadedLog(log, _report(log, draft, notes, config))


def _report(
    log: RobotLog, draft: DraftLog, notes: list[Finding], config: AcceptanceConfig
) -> LogReport:
    drive = drive_statistics(log, config.drive)
    no_echo = np.isnan(log.ranges)
    return LogReport(
        draft.format,
        log.name,
        len(log),
        len(log.ring),
        log.duration_s,
        log.distance_m,
        float(drive.radians.sum()),
        drive.extent_m,
        1 / drive.median_s if drive.median_s > 0 else 0.0,
        float(no_echo.mean()),
        tuple(no_echo.mean(axis=0).tolist()),
        float((~log.fresh).mean()),
        tuple((~log.fresh).mean(axis=0).tolist()),
        len(drive.gap_steps),
        longest_gaps(log, drive, config.drive.listed),
        len(drive.jump_steps),
        largest_jumps(log, drive, config.drive.listed),
        (),
        draft.skipped,
        tuple(notes),
        True,
        (),
    )
