"""The surroundings of a border between two regions: what makes it look like a doorway or not.

Everything here is measured on the map alone, whatever the regions on both sides are. The lengths
belong to the features that the boundary model was fitted to: other values need another fit.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numba
import numpy as np

from core.geometry import BoolArray, FloatArray

BRIDGED = 3.0
"""Cells that may part two points of one stretch."""
OFFSETS = (0.35, 0.7, 1.2)
"""Metres in front of and behind the border at which the width of free space is taken."""
WIDEST = 4.0
"""Metres to each side up to which that width is followed."""
LOOK = (0.75, 1.5)
"""Metres within which the widest open place on each side is sought."""
RAYS = 12
JAMB, JAMB_START = 0.6, 0.1
"""Metres of wall looked for just beside the border, and where that begins."""
WALL_REACH = 2.0
"""Metres of wall looked for in line with the border."""
TURNS, TURN = 4, 2 * math.pi / 180
SHIFTS, SHIFT = 3, 0.05
"""The line of the wall may be turned (steps, radians) and shifted (steps, metres) a little."""


class BoundaryShape(NamedTuple):
    """All in metres but the shares (0..1).

    Attributes:
        length: of the longest stretch, end to end.
        passage: widest disc that passes (diameter).
        near_35, near_70, near_120: width of free space at each offset, on the narrower side.
        wide_70: the same at 0.7 m on the wider side.
        open_75, open_150: diameter of the largest disc within that distance, narrower side.
        jamb_low, jamb_high: share of wall just beside both ends (the lesser, the greater).
        wall_low, wall_high: share of wall in line with the border (the lesser, the greater).
        roughness: standard deviation of the border from a straight line.
    """

    length: float
    passage: float
    near_35: float
    near_70: float
    near_120: float
    wide_70: float
    open_75: float
    open_150: float
    jamb_low: float
    jamb_high: float
    wall_low: float
    wall_high: float
    roughness: float


def boundary_shape(
    points: FloatArray, floor: BoolArray, wall: BoolArray, clearance: FloatArray, resolution: float
) -> BoundaryShape:
    """Measures a border.

    Args:
        points: (n, 2) middles `[row, col]` between the cells of both sides.
        floor: (rows, cols) free space.
        wall: (rows, cols) occupied cells, a cell thicker than they are.
        clearance: (rows, cols) metres to the nearest obstacle.
        resolution: metres per cell.
    """
    length, passage, roughness, frame = _stretch(points, clearance)
    widths = _widths(frame, floor, resolution)
    discs = _open_places(frame, floor, clearance, resolution)
    jamb = _jambs(frame, length, floor, resolution)
    aligned = _walls_in_line(frame, length, wall, resolution)
    around = (*widths, *discs, *jamb, *aligned)
    return BoundaryShape._make((length * resolution, 2 * passage, *around, roughness * resolution))


@numba.njit(cache=True)
def _at(image, row, col):  # type: ignore[no-untyped-def]
    i, j = int(round(row)), int(round(col))
    if i < 0 or j < 0 or i >= image.shape[0] or j >= image.shape[1]:
        return image.dtype.type(0)
    return image[i, j]


@numba.njit(cache=True)
def _stretch(points, clearance):  # type: ignore[no-untyped-def]
    """Length, clearance, roughness (cells) of the longest stretch; its frame: centre, direction."""
    n = len(points)
    mean_r, mean_c = points[:, 0].mean(), points[:, 1].mean()
    rr, rc, cc = 0.0, 0.0, 0.0
    for k in range(n):
        r, c = points[k, 0] - mean_r, points[k, 1] - mean_c
        rr, rc, cc = rr + r * r, rc + r * c, cc + c * c
    angle = 0.5 * math.atan2(2 * rc, rr - cc)
    dr, dc = math.cos(angle), math.sin(angle)
    along = (points[:, 0] - mean_r) * dr + (points[:, 1] - mean_c) * dc
    order = np.argsort(along, kind="mergesort")
    first, last, start = 0, 0, 0
    for k in range(1, n + 1):
        if k == n or along[order[k]] - along[order[k - 1]] > BRIDGED:
            if (
                along[order[k - 1]] - along[order[start]]
                >= along[order[last]] - along[order[first]]
            ):
                first, last = start, k - 1
            start = k
    low, high = along[order[first]], along[order[last]]
    across, squares, passage = 0.0, 0.0, 0.0
    for k in range(first, last + 1):
        i = order[k]
        off = -(points[i, 0] - mean_r) * dc + (points[i, 1] - mean_c) * dr
        across += off
        squares += off * off
        passage = max(passage, clearance[int(points[i, 0]), int(points[i, 1])])
    count = last - first + 1
    across /= count
    rough = math.sqrt(max(squares / count - across * across, 0.0))
    middle = (low + high) / 2
    row, col = mean_r + middle * dr - across * dc, mean_c + middle * dc + across * dr
    return high - low + 1, passage, rough, (row, col, dr, dc)


@numba.njit(cache=True)
def _free_run(floor, row, col, dr, dc, most):  # type: ignore[no-untyped-def]
    k = 0
    while k < most and _at(floor, row + k * dr, col + k * dc):
        k += 1
    return k


@numba.njit(cache=True)
def _widths(frame, floor, resolution):  # type: ignore[no-untyped-def]
    """near_35, near_70, near_120, wide_70. A width also counts where it is found a step nearer."""
    row, col, dr, dc = frame
    most = int(WIDEST / resolution)
    width = np.zeros((2, 3))
    for side in range(2):
        sign = 1 - 2 * side
        for q in range(3):
            off = sign * OFFSETS[q] / resolution
            r, c = row - off * dc, col + off * dr
            width[side, q] = _free_run(floor, r, c, dr, dc, most) + _free_run(
                floor, r - dr, c - dc, -dr, -dc, most
            )
        width[side, 1] = max(width[side, 1], width[side, 0])
    near = resolution * np.minimum(width[0], width[1])
    return near[0], near[1], near[2], resolution * max(width[0, 1], width[1, 1])


@numba.njit(cache=True)
def _open_places(frame, floor, clearance, resolution):  # type: ignore[no-untyped-def]
    """open_75, open_150: what can be seen from the middle of the border counts."""
    row, col, dr, dc = frame
    best = np.zeros((2, 2))
    for q in range(2):
        for side in range(2):
            sign = 1 - 2 * side
            for k in range(1, RAYS):
                angle = math.pi * k / RAYS
                vr = math.cos(angle) * dr - math.sin(angle) * sign * dc
                vc = math.cos(angle) * dc + math.sin(angle) * sign * dr
                step = 1
                while step < LOOK[q] / resolution and _at(floor, row + step * vr, col + step * vc):
                    value = _at(clearance, row + step * vr, col + step * vc)
                    best[q, side] = max(best[q, side], value)
                    step += 1
    return 2 * min(best[0, 0], best[0, 1]), 2 * min(best[1, 0], best[1, 1])


@numba.njit(cache=True)
def _jambs(frame, length, floor, resolution):  # type: ignore[no-untyped-def]
    """jamb_low, jamb_high."""
    row, col, dr, dc = frame
    count, start = int(JAMB / resolution), max(1, int(JAMB_START / resolution))
    share = np.zeros(2)
    for side in range(2):
        sign = 1 - 2 * side
        for k in range(count):
            at = sign * (length / 2 + start + k)
            if not _at(floor, row + at * dr, col + at * dc):
                share[side] += 1 / max(count, 1)
    return share.min(), share.max()


@numba.njit(cache=True)
def _walls_in_line(frame, length, wall, resolution):  # type: ignore[no-untyped-def]
    """wall_low, wall_high on the best of the slightly turned and shifted lines."""
    row, col, dr, dc = frame
    count = int(WALL_REACH / resolution)
    best, low, high = -1.0, 0.0, 0.0
    for turn in range(-TURNS, TURNS + 1):
        cos, sin = math.cos(turn * TURN), math.sin(turn * TURN)
        er, ec = cos * dr - sin * dc, cos * dc + sin * dr
        for shift in range(-SHIFTS, SHIFTS + 1):
            off = shift * SHIFT / resolution
            r, c = row - off * dc, col + off * dr
            ahead, back = 0.0, 0.0
            for k in range(count):
                at = length / 2 + 1 + k
                ahead += _at(wall, r + at * er, c + at * ec)
                back += _at(wall, r - at * er, c - at * ec)
            if ahead + back > best:
                best = ahead + back
                low, high = min(ahead, back) / max(count, 1), max(ahead, back) / max(count, 1)
    return low, high
