"""The occupancy grid: which cell of the world is free, which is occupied, which is unknown."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from core.geometry import BoolArray, FloatArray, IntArray

UNKNOWN, FREE, OCCUPIED = 0, 1, 2
DEFAULT_RESOLUTION = 0.05
"""Metres per cell (paper, Sect. 5)."""


@dataclass(frozen=True)
class GridGeometry:
    """Where the cells of a grid lie in the world. The only place where `(x, y)` meets `[row, col]`.

    Attributes:
        resolution: metres per cell.
        origin: world pose `(x, y, heading)` of the outer corner of cell [0, 0]; row 0 is the lowest
            y, columns grow along the grid's x axis.
        shape: (rows, columns).
    """

    resolution: float
    origin: tuple[float, float, float]
    shape: tuple[int, int]

    @classmethod
    def around(cls, points: FloatArray, margin: float, resolution: float) -> GridGeometry:
        """The smallest grid around world points (N, 2) with a margin in metres.

        The corner lies on a multiple of the resolution, so that grids of one world line up.
        """
        low = np.floor((points.min(axis=0) - margin) / resolution).astype(int)
        high = np.ceil((points.max(axis=0) + margin) / resolution).astype(int)
        return cls(
            resolution,
            (float(low[0] * resolution), float(low[1] * resolution), 0.0),
            (int(high[1] - low[1]), int(high[0] - low[0])),
        )

    def cell_of(self, xy: npt.ArrayLike) -> IntArray:
        """World points (..., 2) -> cells `[row, col]` (..., 2); may lie outside the grid."""
        p = np.asarray(xy, float) - np.array(self.origin[:2])
        cos, sin = np.cos(self.origin[2]), np.sin(self.origin[2])
        along = cos * p[..., 0] + sin * p[..., 1]
        across = -sin * p[..., 0] + cos * p[..., 1]
        return np.floor(np.stack((across, along), axis=-1) / self.resolution + 1e-9).astype(
            np.int64
        )

    def world_of(self, cells: npt.ArrayLike) -> FloatArray:
        """Cells `[row, col]` (..., 2), fractions allowed -> world positions of their centres (..., 2)."""
        c = (np.asarray(cells, float) + 0.5) * self.resolution
        cos, sin = np.cos(self.origin[2]), np.sin(self.origin[2])
        return np.stack(
            (
                self.origin[0] + cos * c[..., 1] - sin * c[..., 0],
                self.origin[1] + sin * c[..., 1] + cos * c[..., 0],
            ),
            axis=-1,
        )

    def contains(self, cells: IntArray) -> BoolArray:
        """Which cells `[row, col]` (..., 2) lie inside the grid."""
        return np.asarray(
            (cells[..., 0] >= 0)
            & (cells[..., 1] >= 0)
            & (cells[..., 0] < self.shape[0])
            & (cells[..., 1] < self.shape[1])
        )

    @property
    def cell_area(self) -> float:
        """Square metres of one cell."""
        return self.resolution**2


@dataclass(frozen=True)
class OccupancyGrid:
    """A trinary grid: `state` (rows, cols) of uint8 holds UNKNOWN, FREE or OCCUPIED."""

    geometry: GridGeometry
    state: npt.NDArray[np.uint8]

    @classmethod
    def of(cls, geometry: GridGeometry, free: BoolArray, occupied: BoolArray) -> OccupancyGrid:
        """A grid from two masks; occupied wins."""
        state = np.zeros(geometry.shape, np.uint8)
        state[free] = FREE
        state[occupied] = OCCUPIED
        return cls(geometry, state)

    @property
    def free(self) -> BoolArray:
        """Mask of the free cells: m(x, y) = 0 in the paper."""
        return np.asarray(self.state == FREE)

    @property
    def occupied(self) -> BoolArray:
        """Mask of the occupied cells: m(x, y) = 1 in the paper."""
        return np.asarray(self.state == OCCUPIED)

    @property
    def unknown(self) -> BoolArray:
        """Mask of the cells that no reading spoke of."""
        return np.asarray(self.state == UNKNOWN)
