"""A distance measured on the floor: two clicks, the next one begins anew."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass
class MeasuredLine:
    """The points (world x, y) that have been clicked, at most two."""

    points: tuple[tuple[float, float], ...] = ()

    @property
    def distance_m(self) -> float | None:
        """Between the points; None as long as there are not two."""
        return math.dist(*self.points) if len(self.points) == 2 else None

    def add(self, point: tuple[float, float]) -> None:
        """Takes the next click."""
        self.points = (point,) if len(self.points) == 2 else (*self.points, point)
