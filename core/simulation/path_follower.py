"""Steering a differential drive along a way."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray, travelled, wrap_angle


@dataclass(frozen=True)
class Cruise:
    """How the robot is driven: m/s, rad/s, how far ahead it aims (m), the heading error (rad) at
    which it stops to turn, and how near (m) the end counts as reached."""

    speed: float = 0.17
    turn_rate: float = 0.6
    look_ahead: float = 0.2
    turn_on_the_spot: float = 0.7
    arrived: float = 0.08
    gain: float = 2.5


class PathFollower:
    """Follows one way (N, 2); `command` gives speed and turn rate for a pose, None at the end."""

    def __init__(self, way: FloatArray, cruise: Cruise) -> None:
        self._way = way
        self._at = travelled(np.column_stack((way, np.zeros(len(way)))))
        self._cruise = cruise
        self._reached = 0

    def command(self, pose: FloatArray) -> tuple[float, float] | None:
        """`(speed, turn_rate)` to go on from `pose` (3,)."""
        cruise, way = self._cruise, self._way
        window = slice(self._reached, self._index_at(self._at[self._reached] + 1.0) + 1)
        distances = np.hypot(way[window, 0] - pose[0], way[window, 1] - pose[1])
        self._reached += int(distances.argmin())
        if self._reached >= len(way) - 1 or (
            self._at[-1] - self._at[self._reached] < cruise.arrived
        ):
            return None
        aim = way[self._index_at(self._at[self._reached] + cruise.look_ahead)]
        bearing = math.atan2(aim[1] - pose[1], aim[0] - pose[0])
        error = float(wrap_angle(bearing - pose[2]))
        turn = float(np.clip(cruise.gain * error, -cruise.turn_rate, cruise.turn_rate))
        if abs(error) > cruise.turn_on_the_spot:
            return 0.0, turn
        return cruise.speed * math.cos(error) ** 2, turn

    def _index_at(self, distance: float) -> int:
        return min(int(np.searchsorted(self._at, distance)), len(self._way) - 1)
