"""From a draft to a log: time put in order, impossible ranges removed, latched values found."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from core.geometry import BoolArray, FloatArray, wrap_angle
from core.log_readers.clock import ClockConfig, ordered_time
from core.log_readers.draft_log import DraftLog, Finding
from core.log_readers.drive_statistics import (
    DriveConfig,
    drive_statistics,
    largest_jumps,
    longest_gaps,
)
from core.log_readers.latched import LatchConfig, measured_anew
from core.log_readers.loaded_log import LoadedLog
from core.log_readers.log_report import LogReport
from core.log_readers.range_check import impossible, usable_ranges
from core.log_readers.verdict import Drive, VerdictConfig, verdict
from core.sensing.robot_log import RobotLog


@dataclass(frozen=True)
class AcceptanceConfig:
    """Settings of the checks that every log goes through."""

    clock: ClockConfig = field(default_factory=ClockConfig)
    latch: LatchConfig = field(default_factory=LatchConfig)
    drive: DriveConfig = field(default_factory=DriveConfig)
    verdict: VerdictConfig = field(default_factory=VerdictConfig)


def accept(draft: DraftLog, config: AcceptanceConfig = AcceptanceConfig()) -> LoadedLog:
    """The log that a draft becomes, and its report.

    Raises:
        LogError: the times make no sense.
    """
    draft = _in_order(draft, config.clock)
    wrong = impossible(draft.ranges, draft.ring)
    draft = replace(draft, notes=(*draft.notes, *_range_notes(draft, wrong)))
    ranges = usable_ranges(draft.ranges, draft.ring)
    fresh = measured_anew(ranges, config.latch) if draft.fresh is None else draft.fresh
    if draft.too_close is not None:
        fresh = fresh & ~draft.too_close
    log = RobotLog(draft.name, draft.ring, draft.t, draft.odometry, ranges, fresh, draft.truth)
    return LoadedLog(log, _report(log, draft, float(wrong.mean()), config))


def _in_order(draft: DraftLog, config: ClockConfig) -> DraftLog:
    """The draft with increasing times and without the rows that have none."""
    time = ordered_time(draft.t, draft.lines, draft.source, config)
    keep = time.keep
    return replace(
        draft,
        t=time.t[keep],
        odometry=_wrapped(draft.odometry[keep]),
        ranges=draft.ranges[keep],
        lines=draft.lines[keep],
        fresh=None if draft.fresh is None else draft.fresh[keep],
        truth=None if draft.truth is None else _wrapped(draft.truth[keep]),
        too_close=None if draft.too_close is None else draft.too_close[keep],
        clock=(*draft.clock, *time.changes),
        skipped=(*draft.skipped, *time.skipped),
    )


def _wrapped(poses: FloatArray) -> FloatArray:
    """Poses (N, 3) with headings in [-pi, pi]; those that already are stay to the last bit."""
    out = poses.copy()
    turns = np.abs(out[:, 2]) > np.pi
    out[turns, 2] = wrap_angle(out[turns, 2])
    return out


def _range_notes(draft: DraftLog, wrong: BoolArray) -> list[Finding]:
    """Impossible ranges, told by what is wrong with them."""
    kinds = (
        ("ranges of zero or less, taken as no echo", wrong & (draft.ranges <= 0)),
        ("ranges beyond the sonar's max_range, taken as no echo", wrong & (draft.ranges > 0)),
    )
    notes = []
    for what, where in kinds:
        rows = np.flatnonzero(where.any(axis=1))
        if len(rows):
            found = Finding.at(what, draft.lines[rows], draft.source)
            notes.append(replace(found, count=int(where.sum())))
    return notes


def _report(log: RobotLog, draft: DraftLog, too_long: float, config: AcceptanceConfig) -> LogReport:
    steps = drive_statistics(log, config.drive)
    good, sentences = verdict(Drive(log, steps, too_long, config.verdict))
    no_echo, latched = np.isnan(log.ranges), ~log.fresh
    return LogReport(
        format=draft.format,
        name=log.name,
        scans=len(log),
        sonars=len(log.ring),
        duration_s=log.duration_s,
        distance_m=log.distance_m,
        turn_rad=float(steps.radians.sum()),
        extent_m=steps.extent_m,
        rate_hz=1 / steps.median_s if steps.median_s > 0 else 0.0,
        no_echo=float(no_echo.mean()),
        no_echo_per_sonar=tuple(no_echo.mean(axis=0).tolist()),
        latched=float(latched.mean()),
        latched_per_sonar=tuple(latched.mean(axis=0).tolist()),
        gap_count=len(steps.gap_steps),
        gaps=longest_gaps(log, steps, config.drive.listed),
        jump_count=len(steps.jump_steps),
        jumps=largest_jumps(log, steps, config.drive.listed),
        clock=draft.clock,
        skipped=draft.skipped,
        notes=draft.notes,
        good_for_map=good,
        verdict=sentences,
    )
