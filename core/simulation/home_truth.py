"""What is really there: the ground truth of a home on a grid, for evaluation only."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit

from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping.occupancy_grid import DEFAULT_RESOLUTION, GridGeometry
from core.sensing.robot_log import RobotLog
from core.simulation.floor_plan import Box, Door
from core.simulation.furniture import Disc
from core.simulation.home import Home

MARGIN = 0.1
"""The grid reaches this far beyond the outer walls (m); all of it counts as occupied."""
EXPLORE_STRIDE = 2
"""Every so many scans are traced to find what a drive has explored."""
EXPLORE_RAY = math.radians(2.0)
"""Angle between the rays that are traced (rad)."""


@dataclass(frozen=True)
class HomeTruth:
    """The truth of a home on a grid (row 0 = lowest y) in the home's frame.

    Attributes:
        geometry: where the cells lie.
        occupied: (rows, cols) walls, furniture and all that lies outside.
        free: (rows, cols) open floor; the complement of occupied.
        rooms: (rows, cols) int64 label image, 0 = not a room, k = `names[k - 1]`.
        names: of the rooms.
        doors: open and shut ones, as boxes in metres.
    """

    geometry: GridGeometry
    occupied: BoolArray
    free: BoolArray
    rooms: IntArray
    names: tuple[str, ...]
    doors: tuple[Door, ...]

    @property
    def door_gaps(self) -> FloatArray:
        """(D, 4) `x0, y0, x1, y1` of the doors, metres."""
        gaps = [(d.gap.x0, d.gap.y0, d.gap.x1, d.gap.y1) for d in self.doors]
        return np.array(gaps, float).reshape(-1, 4)

    def explored(self, log: RobotLog) -> BoolArray:
        """Free cells (rows, cols) that the sonars of a drive really swept.

        A cell counts when it lies inside a beam and nothing solid stands between it and the sonar
        at the true pose; what the sonar read does not matter.

        Raises:
            ValueError: the log has no truth.
        """
        if log.truth is None:
            raise ValueError("explored needs a log with true poses")
        seen = np.zeros(self.geometry.shape, np.bool_)
        mounts = np.array(
            [(s.x, s.y, s.heading, s.beam_width, s.max_range) for s in log.ring.sonars], float
        )
        _sweep(
            self.occupied,
            seen,
            np.ascontiguousarray(log.truth[::EXPLORE_STRIDE]),
            mounts,
            np.array([self.geometry.origin[0], self.geometry.origin[1], self.geometry.resolution]),
        )
        return seen & self.free


def truth_of(home: Home, resolution: float = DEFAULT_RESOLUTION) -> HomeTruth:
    """The truth of a home on a grid of `resolution` metres."""
    bounds = home.bounds
    corners = np.array([(bounds.x0, bounds.y0), (bounds.x1, bounds.y1)])
    geometry = GridGeometry.around(corners, MARGIN, resolution)
    rooms = np.zeros(geometry.shape, np.int64)
    for number, room in enumerate(home.rooms, 1):
        for box in room.boxes:
            rooms[cells_in(box, geometry)] = number
    occupied = rooms == 0
    for wall in home.walls:
        occupied[cells_in(wall, geometry)] = True
    for piece in home.furniture:
        for solid in piece.solids:
            if isinstance(solid, Disc):
                occupied |= _inside_disc(solid, geometry)
            else:
                occupied[cells_in(solid, geometry)] = True
    free = ~occupied
    names = tuple(room.name for room in home.rooms)
    return HomeTruth(geometry, occupied, free, np.where(free, rooms, 0), names, home.doors)


def cells_in(box: Box, geometry: GridGeometry) -> tuple[slice, slice]:
    """Rows and columns of the cells whose centres lie in a box (of a grid that is not turned)."""
    x, y, res = geometry.origin[0], geometry.origin[1], geometry.resolution

    def first(value: float, origin: float, count: int) -> int:
        return min(max(math.ceil((value - origin) / res - 0.5 - 1e-6), 0), count)

    rows, cols = geometry.shape
    return (
        slice(first(box.y0, y, rows), first(box.y1, y, rows)),
        slice(first(box.x0, x, cols), first(box.x1, x, cols)),
    )


def _inside_disc(disc: Disc, geometry: GridGeometry) -> BoolArray:
    rows, cols = np.indices(geometry.shape)
    centres = geometry.world_of(np.stack((rows, cols), axis=-1))
    return np.asarray(
        np.hypot(centres[..., 0] - disc.x, centres[..., 1] - disc.y) <= disc.radius, np.bool_
    )


@njit(cache=True)
def _sweep(
    occupied: BoolArray, seen: BoolArray, poses: FloatArray, mounts: FloatArray, grid: FloatArray
) -> None:
    """Marks in `seen` every cell that a ray of a beam crosses before the first occupied cell."""
    step = grid[2] / 2
    for p in range(len(poses)):
        cos, sin = math.cos(poses[p, 2]), math.sin(poses[p, 2])
        for s in range(len(mounts)):
            x = poses[p, 0] + cos * mounts[s, 0] - sin * mounts[s, 1]
            y = poses[p, 1] + sin * mounts[s, 0] + cos * mounts[s, 1]
            heading = poses[p, 2] + mounts[s, 2]
            rays = int(mounts[s, 3] / EXPLORE_RAY) + 1
            for k in range(rays + 1):
                angle = heading - mounts[s, 3] / 2 + mounts[s, 3] * k / rays
                dx, dy = math.cos(angle) * step, math.sin(angle) * step
                for i in range(int(mounts[s, 4] / step) + 1):
                    row = int(math.floor((y + i * dy - grid[1]) / grid[2]))
                    col = int(math.floor((x + i * dx - grid[0]) / grid[2]))
                    if row < 0 or col < 0 or row >= seen.shape[0] or col >= seen.shape[1]:
                        break
                    if occupied[row, col]:
                        break
                    seen[row, col] = True
