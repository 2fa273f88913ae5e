"""The tentative cut of the paper's extraction and whether it is to be made (3.2.2, steps 1-4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.mapping import OccupancyGrid
from core.segmentation.convex_split import TwoWayCut, two_way_cut
from core.segmentation.convexity import ConvexityConfig, convexity, is_to_be_cut
from core.segmentation.paper_config import PaperConfig


@dataclass(frozen=True)
class TentativeCut:
    """Two clusters, eq. (7) of both together, whether eq. (9) parts them, and why (not)."""

    cut: TwoWayCut
    one: float
    accepted: bool
    reason: str


def least_grids(grid: OccupancyGrid, config: PaperConfig) -> float:
    """The area of the smallest cluster in grids."""
    return config.least_area / grid.geometry.cell_area


def tentative_cut(
    cells: BoolArray, grid: OccupancyGrid, config: PaperConfig
) -> TentativeCut | None:
    """The normalized cut of cells (rows, cols) in two, measured; None where there is none."""
    cut = two_way_cut(cells, least_grids(grid, config), config.max_cell)
    if cut is None:
        return None
    one = convexity((cells,), grid, config.convexity)  # eq. (7)
    two = convexity((cut.first, cut.second), grid, config.convexity)  # eq. (8)
    border = cut.width / float(np.sqrt(min(cut.first.sum(), cut.second.sum())))
    accepted = is_to_be_cut(one, two, border, config.convexity)  # eq. (9)
    return TentativeCut(cut, one, accepted, _reason(one, two, border, config.convexity))


def _reason(one: float, two: float, border: float, config: ConvexityConfig) -> str:
    """Eq. (9) in words."""
    if one <= config.threshold:
        return f"convex enough: C1 = {one:.2f} is not above c_t = {config.threshold:g}"
    factor = config.factor_at(border)
    place = "at a narrow place " if config.is_narrow(border) else ""
    if two >= factor * one:
        return f"the cut gains too little: {place}C2 = {two:.2f} is not below {factor * one:.2f}"
    return (
        f"C1 = {one:.2f} is above c_t = {config.threshold:g}, "
        f"{place}C2 = {two:.2f} below {factor * one:.2f}"
    )


def by_distance(cut: TwoWayCut, robot: IntArray) -> tuple[BoolArray, BoolArray]:
    """The half whose centre is nearer to the robot, then the other one."""
    halves = cut.first, cut.second
    away = [np.hypot(*(np.argwhere(half).mean(axis=0) - robot)) for half in halves]
    return halves if away[0] <= away[1] else (halves[1], halves[0])


def frontier_share(cluster: BoolArray, grid: OccupancyGrid) -> float:
    """Share of a cluster's rim that is unexplored."""
    return float(grid.unknown[ndimage.binary_dilation(cluster) & ~cluster].mean())
