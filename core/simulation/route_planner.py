"""Where a simulated robot can drive, and the way from here to there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import ndimage
from skimage.graph import MCP_Geometric

from core.errors import InputError
from core.geometry import BoolArray, FloatArray, IntArray
from core.simulation.home import Home
from core.simulation.home_truth import HomeTruth, cells_in, truth_of

CLEARANCE = 0.05
"""Free space kept around the robot's disc (m)."""
COMFORT = 0.45
"""Clearance (m) from its centre at which the robot no longer cares how much more there is."""
LEAST_FLOOR = 1.0
"""A robot that can be on less floor than this (m2) is not driven."""
NARROW_COST = 4.0
"""A way along the tightest passage counts this many times its length more."""


class RoutePlanner:
    """The cells of a home that a robot's centre may occupy, and routes through them.

    Args:
        around: a world point; the part of the home that is connected to the place nearest to it
            is driven in, by default the largest part.

    Raises:
        InputError: the robot is too large to drive anywhere.
    """

    def __init__(
        self, home: Home, robot_radius: float, around: Sequence[float] | FloatArray | None = None
    ) -> None:
        self.truth: HomeTruth = truth_of(home)
        self.geometry = self.truth.geometry
        blocked = self.truth.occupied.copy()
        for piece in home.furniture:
            blocked[cells_in(piece.footprint, self.geometry)] = True
        cell = self.geometry.resolution
        self.clearance = np.asarray(ndimage.distance_transform_edt(~blocked) * cell - cell / 2)
        """(rows, cols) metres from each cell's centre to the nearest thing."""
        wide = self.clearance >= robot_radius + CLEARANCE
        self.passable: BoolArray = (
            largest_part(wide) if around is None else self._part_around(wide, around)
        )
        """(rows, cols) where the robot's centre may be: one connected part."""
        if self.passable.sum() * self.geometry.cell_area < LEAST_FLOOR:
            raise InputError(
                f"a robot of {robot_radius:g} m radius cannot drive in the home {home.name!r}: "
                "take a ring with a smaller radius"
            )
        tight = np.clip(1.0 - (self.clearance - robot_radius) / COMFORT, 0.0, 1.0)
        self._cost = np.where(self.passable, 1.0 + NARROW_COST * tight**2, -1.0)

    def passable_cells(self) -> IntArray:
        """All passable cells `[row, col]` (N, 2)."""
        return np.argwhere(self.passable)

    def nearest_passable(self, xy: Sequence[float] | FloatArray) -> FloatArray:
        """The passable position closest to a world point."""
        return np.asarray(self.geometry.world_of(self._nearest(self.passable, xy)))

    def route(self, start: FloatArray, goal: FloatArray) -> FloatArray:
        """A way (N, 2) in metres from one passable position to another, away from obstacles."""
        from_cell = tuple(int(v) for v in self.geometry.cell_of(self.nearest_passable(start)))
        to_cell = tuple(int(v) for v in self.geometry.cell_of(self.nearest_passable(goal)))
        search = MCP_Geometric(self._cost)
        search.find_costs([from_cell], [to_cell])
        cells = np.array(search.traceback(to_cell))
        return smoothed(self.geometry.world_of(cells))

    def _part_around(self, mask: BoolArray, xy: Sequence[float] | FloatArray) -> BoolArray:
        """The connected part (4-neighbours) of a mask that comes nearest to a world point."""
        labels, count = ndimage.label(mask)
        if count == 0:
            return mask
        row, col = self._nearest(mask, xy)
        return np.asarray(labels == labels[row, col])

    def _nearest(self, mask: BoolArray, xy: Sequence[float] | FloatArray) -> IntArray:
        """The cell `[row, col]` (2,) of a mask that is nearest to a world point."""
        cells = np.argwhere(mask)
        centres = self.geometry.world_of(cells)
        return np.asarray(cells[np.argmin(((centres - np.asarray(xy)) ** 2).sum(axis=1))])


def smoothed(way: FloatArray, reach: int = 4) -> FloatArray:
    """A way (N, 2) with every point moved to the mean of its neighbours up to `reach` away."""
    if len(way) < 3:
        return way
    padded = np.vstack((np.repeat(way[:1], reach, 0), way, np.repeat(way[-1:], reach, 0)))
    window = 2 * reach + 1
    sums = np.cumsum(np.vstack((np.zeros((1, 2)), padded)), axis=0)
    mean = (sums[window:] - sums[:-window]) / window
    mean[0], mean[-1] = way[0], way[-1]
    return np.asarray(mean)


def largest_part(mask: BoolArray) -> BoolArray:
    """The largest connected part (4-neighbours) of a mask; the mask itself when it is empty."""
    labels, count = ndimage.label(mask)
    if count < 2:
        return mask
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    return np.asarray(labels == sizes.argmax())
