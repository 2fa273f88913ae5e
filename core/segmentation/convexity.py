"""The paper's convexity measures and its condition for a cut (eq. 7-9)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from core.geometry import BoolArray, FloatArray
from core.mapping import OccupancyGrid
from core.segmentation.convex_hull import convex_hull, marked_in_hull


@dataclass(frozen=True)
class ConvexityConfig:
    """The condition of eq. (9) with its open points.

    Attributes:
        counted: what "# of occ. grids" means. "occupied" as printed: a wall is one or two grids
            thick, a whole house scores 0.1 and nothing is ever cut. "not_free": unknown grids
            count too, which is what lies behind a wall; this works.
        threshold: c_t.
        narrow: longest border between two clusters that is a narrow place, in square roots of the
            smaller one's area; None as printed: none is. Furniture in a room counts before and
            after a cut at its door, but a cut across the room halves what counts: with one factor
            for both, rooms are cut up (twelve simulated homes: purity .92, adjusted Rand index
            .47; with two .92 and .56).
        factor: of the second condition; 0.5 as printed. Cuts of furnished rooms reach 0.4.
        narrow_factor: the same at a narrow place.
    """

    counted: Literal["occupied", "not_free"] = "not_free"
    threshold: float = 0.2
    narrow: float | None = 0.65
    factor: float = 0.3
    narrow_factor: float = 0.9

    def is_narrow(self, border: float) -> bool:
        """Whether a border as long as this is a narrow place."""
        return self.narrow is not None and border <= self.narrow

    def factor_at(self, border: float) -> float:
        """The factor of the second condition at a border as long as this."""
        return self.narrow_factor if self.is_narrow(border) else self.factor


PRINTED = ConvexityConfig("occupied", threshold=0.2, narrow=None, factor=0.5)
"""Eq. (7)-(9) as they are printed."""


def blocked_in_hull(cluster: BoolArray, grid: OccupancyGrid, config: ConvexityConfig) -> int:
    """# of occ. grids in the convex hull of a cluster (rows, cols)."""
    if not cluster.any():
        return 0
    blocked = grid.occupied if config.counted == "occupied" else ~grid.free
    return int(marked_in_hull(convex_hull(rim_of(cluster)), blocked))


def rim_of(cluster: BoolArray) -> FloatArray:
    """The first and the last grid `[row, col]` (n, 2) of each row: they span the convex hull."""
    rows = np.flatnonzero(cluster.any(axis=1))
    first = cluster[rows].argmax(axis=1)
    last = cluster.shape[1] - 1 - cluster[rows, ::-1].argmax(axis=1)
    ends = np.concatenate((np.column_stack((rows, first)), np.column_stack((rows, last))))
    return np.unique(ends, axis=0).astype(float)


def convexity(
    clusters: tuple[BoolArray, ...], grid: OccupancyGrid, config: ConvexityConfig | None = None
) -> float:
    """C of eq. (7) for one cluster, of eq. (8) for two: blocked grids in the hulls per grid."""
    config = config or ConvexityConfig()
    size = sum(int(cluster.sum()) for cluster in clusters)
    blocked = sum(blocked_in_hull(cluster, grid, config) for cluster in clusters)
    return blocked / size if size else 0.0


def is_to_be_cut(
    one: float, two: float, border: float, config: ConvexityConfig | None = None
) -> bool:
    """Eq. (9) for two clusters with a border of this length (in roots of the smaller one's area)."""
    config = config or ConvexityConfig()
    return one > config.threshold and two < config.factor_at(border) * one
