"""Where the robot may be: a probability for every place and heading, and one for being elsewhere."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from core.geometry import BoolArray, FloatArray
from core.mapping.occupancy_grid import GridGeometry

MassArray = npt.NDArray[np.float32]


@dataclass(frozen=True)
class PoseGrid:
    """The places and headings that are told apart.

    Attributes:
        geometry: the places.
        standable: (rows, cols) where the robot's centre can be.
        headings: how many headings a full turn has; heading 0 looks along the grid's columns.
    """

    geometry: GridGeometry
    standable: BoolArray
    headings: int

    @property
    def heading_step(self) -> float:
        """Radians between two headings."""
        return 2 * math.pi / self.headings

    @property
    def poses(self) -> int:
        """How many poses are possible."""
        return int(self.standable.sum()) * self.headings

    def world_pose(self, heading: float, row: float, col: float) -> FloatArray:
        """The world pose (3,) of an index, fractions allowed."""
        x, y = self.geometry.world_of(np.array([row, col]))
        angle = heading * self.heading_step + self.geometry.origin[2]
        return np.array([x, y, math.remainder(angle, 2 * math.pi)])


@dataclass(frozen=True)
class PoseBelief:
    """The belief: `mass` (headings, rows, cols) and `unknown` (outside the map) sum to 1."""

    mass: MassArray
    unknown: float

    @classmethod
    def anywhere(cls, grid: PoseGrid, unknown: float) -> PoseBelief:
        """Nothing is known: every standable pose is as likely as any other."""
        mass = np.zeros((grid.headings, *grid.standable.shape), np.float32)
        mass[:, grid.standable] = (1 - unknown) / max(grid.poses, 1)
        return cls(mass, unknown if grid.poses else 1.0)
