"""Wheel odometry that drifts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.errors import UsageError
from core.geometry import FloatArray, compose


@dataclass(frozen=True)
class OdometryErrors:
    """Standard deviations of the errors of odometry; the systematic ones are drawn once per drive.

    Attributes:
        distance_scale: relative error of every distance (systematic).
        turn_scale: relative error of every turn (systematic).
        drift_per_metre: turn that is not there, rad per metre driven (systematic).
        random_distance: metres per square root of a metre driven.
        random_turn: rad per square root of a metre driven.
    """

    distance_scale: float
    turn_scale: float
    drift_per_metre: float
    random_distance: float
    random_turn: float


ODOMETRY: dict[str, OdometryErrors] = {
    "none": OdometryErrors(0.0, 0.0, 0.0, 0.0, 0.0),
    "calibrated": OdometryErrors(0.002, 0.003, math.radians(0.03), 0.005, math.radians(0.2)),
    "bad": OdometryErrors(0.02, 0.02, math.radians(0.3), 0.015, math.radians(0.8)),
}
"""Odometry by name; `none`: no errors."""


def odometry_errors(name: str) -> OdometryErrors:
    """The errors of that name.

    Raises:
        UsageError: there are none of that name.
    """
    if name not in ODOMETRY:
        raise UsageError(f"odometry {name!r} is not one of {', '.join(ODOMETRY)}")
    return ODOMETRY[name]


STRAIGHT = 1e-9
"""Arcs that turn by less than this (rad) are driven as straight lines."""


class SimulatedOdometry:
    """What the wheels believe; `pose` is in the odometry frame."""

    def __init__(self, errors: OdometryErrors, start: FloatArray, rng: np.random.Generator) -> None:
        self.pose = np.array(start, float)
        self._errors = errors
        self._rng = rng
        scale, turn, drift = rng.standard_normal(3)
        self._distance_factor = 1.0 + scale * errors.distance_scale
        self._turn_factor = 1.0 + turn * errors.turn_scale
        self._drift = drift * errors.drift_per_metre

    def move(self, distance: float, turn: float) -> None:
        """Takes in a true motion along an arc: metres along it and radians turned."""
        along, around = self._rng.standard_normal(2)
        root = math.sqrt(abs(distance))
        measured = distance * self._distance_factor + along * self._errors.random_distance * root
        turned = turn * self._turn_factor + self._drift * abs(distance)
        turned += around * self._errors.random_turn * root
        self.pose = advanced(self.pose, measured, turned)

    def jump(self, offset: FloatArray) -> None:
        """A fault: the pose changes by `offset` (3,), seen from the robot, without any motion."""
        self.pose = compose(self.pose, offset)


def advanced(pose: FloatArray, distance: float, turn: float) -> FloatArray:
    """The pose (3,) after driving `distance` metres along an arc that turns by `turn` radians."""
    half = turn / 2
    chord = distance * math.sin(half) / half if abs(half) > STRAIGHT else distance
    along = float(pose[2]) + half
    return np.array(
        [
            pose[0] + chord * math.cos(along),
            pose[1] + chord * math.sin(along),
            math.remainder(float(pose[2]) + turn, 2 * math.pi),
        ]
    )
