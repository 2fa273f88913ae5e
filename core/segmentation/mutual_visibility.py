"""How much of each other the cells of a decomposition see, so that any union of them is judged at once.

The share of hidden pairs of a region is a sum over pairs of its cells. Counted once for each pair of
cells, it tells the convexity of every region that can be made of them without another look.
"""

from __future__ import annotations

import numba
import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping import OccupancyGrid
from core.segmentation.hidden_pairs import STEP

POINTS = 1500
"""Look-outs on the floor at most, on a lattice: a million lines of sight, less than a second."""
FINEST = 0.25
"""Metres between two look-outs at least."""
SPECK_GAP, SPECK_AREA = 2, 0.05
"""Obstacles within two dilations of each other are one; less than .05 m2 of them is a speck. On maps
of simulated homes the share of hidden pairs is then nearest to that of the home itself."""


def sight_blockers(grid: OccupancyGrid) -> BoolArray:
    """What hides (rows, cols): obstacles without specks; what is merely unknown hides nothing."""
    near = ndimage.binary_dilation(grid.occupied, iterations=SPECK_GAP)
    groups, count = ndimage.label(near, np.ones((3, 3)))
    area = np.bincount(groups[grid.occupied], minlength=count + 1) * grid.geometry.cell_area
    return np.asarray(grid.occupied & (area >= SPECK_AREA)[groups])


def hidden_between(cells: IntArray, blocked: BoolArray, resolution: float) -> FloatArray:
    """Share (n, n) of the lines of sight from cell k + 1 to cell l + 1 that are blocked.

    Args:
        cells: (rows, cols) label image of n cells 1..n, 0 outside.
        blocked: what nobody sees through.
        resolution: metres per cell of the grid.
    """
    count = int(cells.max(initial=0))
    spacing = max(FINEST / resolution, np.sqrt((cells > 0).sum() / POINTS))
    step = max(1, round(float(spacing)))
    points = np.argwhere(cells[::step, ::step] > 0) * step
    points = np.concatenate((points, _one_each(cells, points, count)))
    of = cells[points[:, 0], points[:, 1]] - 1
    looks = np.bincount(of, minlength=count)
    return _blocked_lines(points, of, count, blocked) / np.outer(looks, looks)


def _one_each(cells: IntArray, points: IntArray, count: int) -> IntArray:
    """A grid `[row, col]` of every cell that no look-out lies in."""
    without = np.setdiff1d(np.arange(1, count + 1), cells[points[:, 0], points[:, 1]])
    middles = [np.argwhere(cells == value) for value in without]
    return np.array([inside[len(inside) // 2] for inside in middles], np.int64).reshape(-1, 2)


@numba.njit(cache=True)
def _blocked_lines(points: IntArray, of: IntArray, count: int, blocked: BoolArray) -> FloatArray:
    found = np.zeros((count, count))
    for a in range(len(points)):
        row, col = points[a, 0] + 0.5, points[a, 1] + 0.5
        for b in range(a):
            d_row, d_col = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1]
            steps = int(np.hypot(d_row, d_col) / STEP) + 1
            for i in range(1, steps):
                if blocked[int(row + d_row * i / steps), int(col + d_col * i / steps)]:
                    found[of[a], of[b]] += 1
                    found[of[b], of[a]] += 1
                    break
    return found
