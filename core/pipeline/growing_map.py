"""The map as it grows along a drive: what autonomous modelling looks at."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from core.geometry import IntArray, travelled, wrap_angle
from core.mapping.map_result import MapResult
from core.pipeline.mapper import MappingOptions, map_log
from core.segmentation.moment import Moment
from core.sensing import RobotLog, Trajectory

KEY_DISTANCE, KEY_TURN = 0.12, 0.25
"""Metres and radians between key scans. At 0.15 m/s and 4 Hz every third or fourth scan is one; a
map of every fourth scan measured as good as one of all."""


def stops_along(trajectory: Trajectory, step: float) -> IntArray:
    """Indices of the scans at which the drive passes a multiple of `step` metres.

    They depend on the distance from the start of the drive only, so that a drive in two logs, or
    scan by scan, stops at the same places.
    """
    passed = np.floor(travelled(trajectory.poses) / step)
    return np.flatnonzero(np.diff(passed) > 0).astype(np.int64) + 1


def moments_along(
    log: RobotLog,
    trajectory: Trajectory,
    options: MappingOptions,
    stops: IntArray,
    window: float | None = None,
) -> Iterator[Moment]:
    """What the robot knows at each stop, the map made of key scans only.

    Args:
        log: the drive.
        trajectory: its poses.
        options: mapping method and resolution.
        stops: indices of scans.
        window: metres of travel that a local map holds; None takes the whole drive so far.
    """
    keys, driven = key_scans(trajectory), travelled(trajectory.poses)
    for stop in stops:
        recent = keys[keys <= stop]
        if window is not None:
            recent = recent[driven[recent] >= driven[stop] - window]
        result = map_log(log.taken(recent), trajectory.taken(recent), options)
        yield _moment(trajectory, int(stop), result)


def last_moment(trajectory: Trajectory, result: MapResult) -> Moment:
    """The end of a drive."""
    return _moment(trajectory, len(trajectory) - 1, result)


def _moment(trajectory: Trajectory, stop: int, result: MapResult) -> Moment:
    pose, distance = trajectory.poses[stop], float(travelled(trajectory.poses[: stop + 1])[-1])
    return Moment(float(trajectory.t[stop]), distance, pose, result.grid, result.confidence)


def key_scans(trajectory: Trajectory) -> IntArray:
    """Indices of scans that lie apart from the one before: a map needs no more."""
    keys, last = [], None
    for i, pose in enumerate(trajectory.poses):
        if (
            last is None
            or np.hypot(*(pose[:2] - last[:2])) >= KEY_DISTANCE
            or abs(float(wrap_angle(pose[2] - last[2]))) >= KEY_TURN
        ):
            keys.append(i)
            last = pose
    return np.array(keys, np.int64)
