"""Where the odometry breaks off: a jump of its values, or a robot that was carried.

Both show as a moment at which the local map before does not go on after it. At a jump the odometry steps
farther than the robot can drive, while the sonar goes on as if nothing had happened: the step is taken
out. When the robot was carried, the sonar sees another place at once: what follows has no place in the
map of what was before, and nothing in the odometry tells where it belongs.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from core.geometry import FloatArray, IntArray, wrap_angle
from core.mapping.matching_config import MatchingConfig
from core.mapping.odometry_model import integrate, motions
from core.mapping.point_frames import points_of_stretch
from core.mapping.reflection_points import ReflectionPoints, path_length, reflection_points
from core.mapping.scan_matching import match
from core.mapping.submap import submap
from core.sensing.robot_log import RobotLog


class BreakKind(StrEnum):
    """What happened."""

    JUMP = "jump"
    CARRIED = "carried"


@dataclass(frozen=True)
class OdometryBreak:
    """A break between the scans `scan - 1` and `scan`; `step` (m) is what the odometry says there."""

    scan: int
    t: float
    kind: BreakKind
    step: float


@dataclass(frozen=True)
class BreakConfig:
    """Parameters.

    Attributes:
        step_factor, step_floor: a step is implausible beyond this multiple of the 95th percentile of
            the drive's steps and beyond the floor (m).
        speed: and only when it is faster than this (m/s).
        turn_floor: an implausible turn in one step (rad).
        changed: a range changed when it did so by more than the step and this (m).
        changed_share: the robot may have been carried where at least this share of ranges changed.
        min_ranges: fewer ranges to compare tell nothing.
        window: travel (m) of the local maps before and after.
        continuity: the maps do not go on when they agree by less than this share of what is normal in
            the log.
        samples: places where the normal agreement is measured.
    """

    step_factor: float = 6.0
    step_floor: float = 0.25
    speed: float = 2.0
    turn_floor: float = 1.0
    changed: float = 0.15
    changed_share: float = 0.7
    min_ranges: int = 4
    window: float = 2.0
    continuity: float = 0.35
    samples: int = 24


def find_breaks(
    log: RobotLog, config: BreakConfig | None = None, matching: MatchingConfig | None = None
) -> tuple[OdometryBreak, ...]:
    """The breaks of a drive in the order of time."""
    config, matching = config or BreakConfig(), matching or MatchingConfig()
    if len(log) < 3:
        return ()
    jumps = _implausible_steps(log, config)
    candidates = sorted({*jumps.tolist(), *_sudden_changes(log, config).tolist()})
    if not candidates:
        return ()
    smooth = _without_steps(log.odometry, jumps)
    steps = np.hypot(*np.diff(log.odometry[:, :2], axis=0).T)
    points = reflection_points(log, smooth)
    length = path_length(smooth, 0.3)
    normal = _normal_continuity(points, smooth, length, config, matching)
    found = []
    for scan in candidates:
        seen = _continuity(points, smooth, length, scan, config, matching)
        goes_on = seen is None or seen >= config.continuity * normal
        is_jump = scan in jumps
        if is_jump or not goes_on:
            kind = BreakKind.JUMP if goes_on else BreakKind.CARRIED
            found.append(OdometryBreak(scan, float(log.t[scan]), kind, float(steps[scan - 1])))
    return tuple(found)


def without_jumps(log: RobotLog, breaks: tuple[OdometryBreak, ...]) -> RobotLog:
    """The log with the steps of all jumps replaced by the motion before them."""
    scans = np.array([b.scan for b in breaks if b.kind is BreakKind.JUMP], np.int64)
    return replace(log, odometry=_without_steps(log.odometry, scans)) if len(scans) else log


def _implausible_steps(log: RobotLog, config: BreakConfig) -> IntArray:
    """Scans whose step from the one before no robot of this drive's pace makes."""
    step = np.hypot(*np.diff(log.odometry[:, :2], axis=0).T)
    turn = np.abs(wrap_angle(np.diff(log.odometry[:, 2])))
    dt = np.maximum(np.diff(log.t), 1e-3)
    limit = max(config.step_floor, config.step_factor * float(np.percentile(step, 95)))
    turn_limit = max(config.turn_floor, config.step_factor * float(np.percentile(turn, 95)))
    far = (step > limit) & (step > config.speed * dt)
    return np.asarray(np.flatnonzero(far | (turn > turn_limit)) + 1, np.int64)


def _sudden_changes(log: RobotLog, config: BreakConfig) -> IntArray:
    """Scans in which most sonars see something else than in the scan before, and go on to do so."""
    step = np.hypot(*np.diff(log.odometry[:, :2], axis=0).T)[:, None] + config.changed
    both = log.fresh[1:] & log.fresh[:-1]
    with np.errstate(invalid="ignore"):
        change = np.abs(np.diff(log.ranges, axis=0))
    comparable = both & np.isfinite(change)
    changed = (comparable & (np.nan_to_num(change) > step)).sum(axis=1)
    count = comparable.sum(axis=1)
    sudden = (count >= config.min_ranges) & (changed >= config.changed_share * count)
    return np.asarray(np.flatnonzero(sudden) + 1, np.int64)


def _without_steps(poses: FloatArray, scans: IntArray) -> FloatArray:
    """Poses with the motion into each of the scans replaced by the one before it."""
    if len(scans) == 0:
        return poses
    steps = motions(poses)
    bad = np.zeros(len(steps), bool)
    bad[scans - 1] = True
    last = np.zeros(3)
    for i in range(len(steps)):
        if bad[i]:
            steps[i] = last
        last = steps[i]
    return integrate(poses[0], steps)


def _continuity(
    points: ReflectionPoints,
    poses: FloatArray,
    length: FloatArray,
    scan: int,
    config: BreakConfig,
    matching: MatchingConfig,
) -> float | None:
    """How well the local map after a scan goes on where the one before it ends; None: too little seen."""
    here = float(length[scan])
    cut = int(np.searchsorted(points.scan, scan))
    part = points_of_stretch(points, length, here - config.window, here + config.window)
    before = submap(points, poses, scan, slice(part.start, cut), matching)
    after = submap(points, poses, scan, slice(cut, part.stop), matching)
    there = match(after, before, np.zeros(3), matching.cell, matching.turn_step, matching)
    back = match(before, after, np.zeros(3), matching.cell, matching.turn_step, matching)
    if there is None or back is None:
        return None
    return min(there.score, back.score)


def _normal_continuity(
    points: ReflectionPoints,
    poses: FloatArray,
    length: FloatArray,
    config: BreakConfig,
    matching: MatchingConfig,
) -> float:
    """The median continuity of the drive."""
    places = np.linspace(0.05, 0.95, config.samples) * length[-1]
    scans = np.unique(np.searchsorted(length, places)).clip(1, len(length) - 1)
    seen = [_continuity(points, poses, length, int(s), config, matching) for s in scans]
    known = [value for value in seen if value is not None]
    return float(np.median(known)) if known else 0.0
