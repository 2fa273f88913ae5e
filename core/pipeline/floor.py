"""The floor: the free space of a map that is divided into regions."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray
from core.mapping import FREE, UNKNOWN, OccupancyGrid
from core.mapping.map_result import MapResult
from core.segmentation.connected import reachable_floor
from core.sensing import Trajectory

PASSAGE = 0.3
"""Metres: free space that hangs on the rest by less is a leak of the map, not a place to go to."""
HEARSAY = 1.0
"""Square metres: largest part of free space that may rest on one reading. On 136 simulated drives that
this was chosen on, the largest such part inside a room had .58; all 14 above 1 lay behind a wall.
"""


def floor_of_drive(result: MapResult, trajectory: Trajectory) -> BoolArray:
    """The free space (rows, cols) that hangs together with where the robot has been."""
    geometry = result.grid.geometry
    cells = geometry.cell_of(trajectory.poses[:, :2])
    seeds = cells[geometry.contains(cells)]
    free = result.grid.free & ~hearsay(result)
    return reachable_floor(free, seeds, PASSAGE / 2 / geometry.resolution)


def hearsay(result: MapResult) -> BoolArray:
    """Large parts of free space (rows, cols) for which a single reading vouches.

    An echo that went astray at a corner frees a fan behind the wall, which no other reading
    contradicts: none gets there. A room that the robot looks into is seen by many. What begins
    under the robot itself is no hearsay: at the start of a drive there is nothing else.
    """
    grid = result.grid
    alone = grid.free & (result.witnesses == 1)
    large = large_parts(alone, round(HEARSAY / grid.geometry.cell_area))
    parts, _ = ndimage.label(large)
    unseen = grid.free & (result.witnesses == 0)
    at_robot = np.unique(parts[ndimage.binary_dilation(unseen) & large])
    return np.asarray(large & ~np.isin(parts, at_robot))


def restricted(grid: OccupancyGrid, floor: BoolArray) -> OccupancyGrid:
    """The grid with the free cells outside the floor taken as unknown."""
    state = np.where((grid.state == FREE) & ~floor, UNKNOWN, grid.state).astype(np.uint8)
    return OccupancyGrid(grid.geometry, state)


def large_parts(free: BoolArray, least_cells: int) -> BoolArray:
    """The connected parts of free space of at least so many cells, together."""
    labels, _ = ndimage.label(free)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    return np.asarray((sizes >= max(1, least_cells))[labels])
