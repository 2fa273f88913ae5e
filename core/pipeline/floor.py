"""The floor: the free space of a map that is divided into regions."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray
from core.mapping import FREE, UNKNOWN, OccupancyGrid
from core.segmentation.connected import reachable_floor
from core.sensing import Trajectory

PASSAGE = 0.3
"""Metres: free space that hangs on the rest by less is a leak of the map, not a place to go to."""


def floor_of_drive(grid: OccupancyGrid, trajectory: Trajectory) -> BoolArray:
    """The free space (rows, cols) that hangs together with where the robot has been."""
    cells = grid.geometry.cell_of(trajectory.poses[:, :2])
    seeds = cells[grid.geometry.contains(cells)]
    return reachable_floor(grid.free, seeds, PASSAGE / 2 / grid.geometry.resolution)


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
