"""A moment of a drive at which regions are looked for: where the robot is and what it knows."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from core.geometry import FloatArray, IntArray
from core.mapping import OccupancyGrid
from core.segmentation.automatic import segment_rooms


@dataclass(frozen=True)
class Moment:
    """One step of extraction along a drive.

    Attributes:
        t: seconds.
        distance: metres driven so far.
        pose: (3,) the robot in the map's frame.
        grid: the map as it is now; its corner lies on a multiple of the resolution.
        confidence: (rows, cols) Conf of eq. (5).
    """

    t: float
    distance: float
    pose: FloatArray
    grid: OccupancyGrid
    confidence: FloatArray

    @cached_property
    def rooms(self) -> IntArray:
        """(rows, cols) the rooms that automatic segmentation sees on the map, 0 = none."""
        if not self.grid.free.any():
            return np.zeros(self.grid.geometry.shape, np.int64)
        return segment_rooms(self.grid)
