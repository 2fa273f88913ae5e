"""The surroundings of a border between two regions: what makes it look like a doorway or not.

Everything here is measured on the map alone, whatever the regions on both sides are. The lengths
belong to the features that the boundary model was fitted to: other values need another fit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numba
import numpy as np

from core.geometry import BoolArray, FloatArray
from core.segmentation.boundary_walls import flush_walls, jambs, walls_in_line
from core.segmentation.map_character import MapCharacter
from core.segmentation.map_probe import free_run, value_at

BRIDGED = 3.0
"""Cells that may part two points of one stretch."""
OFFSETS = (0.35, 0.7, 1.2)
"""Metres in front of and behind the border at which the width of free space is taken."""
WIDEST = 4.0
"""Metres to each side up to which that width is followed."""
LOOK = (0.75, 1.5)
"""Metres within which the widest open place on each side is sought."""
RAYS = 12


@dataclass(frozen=True)
class Surroundings:
    """What borders are measured on.

    Attributes:
        floor: (rows, cols) free space.
        wall: (rows, cols) occupied cells, a cell thicker than they are.
        clearance: (rows, cols) metres to the nearest obstacle.
        bare: (rows, cols) the same when furniture that stands alone is carried out.
        axis: direction of the main walls (radians, modulo a right angle).
        resolution: metres per cell.
        character: of the whole map.
    """

    floor: BoolArray
    wall: BoolArray
    clearance: FloatArray
    bare: FloatArray
    axis: float
    resolution: float
    character: MapCharacter


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
        wall_line: metres of wall in line with the border far and wide.
        roughness: standard deviation of the border from a straight line.
        bare_passage: widest disc that passes once furniture is carried out (diameter).
        turned: 0 along the main walls of the map or at right angles to them, 1 at 45 degrees.
        flush_low, flush_high: share of wall that goes on at right angles from the ends of the
            border, on the side with less and on the one with more; both high within a corridor.
        flush_line: share that does so on both sides of the better end.
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
    wall_line: float
    roughness: float
    bare_passage: float
    turned: float
    flush_low: float
    flush_high: float
    flush_line: float


def boundary_shape(points: FloatArray, around: Surroundings) -> BoundaryShape:
    """Measures a border.

    Args:
        points: (n, 2) middles `[row, col]` between the cells of both sides.
        around: what it is measured on.
    """
    floor, resolution = around.floor, around.resolution
    length, passage, roughness, frame = _stretch(points, around.clearance)
    rows, cols = points.astype(np.int64).T
    turned = abs(math.sin(2 * (math.atan2(frame[2], frame[3]) - around.axis)))
    return BoundaryShape._make(
        (
            length * resolution,
            2 * passage,
            *_widths(frame, floor, resolution),
            *_open_places(frame, floor, around.clearance, resolution),
            *jambs(frame, length, floor, resolution),
            *walls_in_line(frame, length, around.wall, resolution),
            roughness * resolution,
            2 * float(around.bare[rows, cols].max()),
            turned,
            *flush_walls(frame, length, floor, resolution),
        )
    )


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
            width[side, q] = free_run(floor, r, c, dr, dc, most) + free_run(
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
                while step < LOOK[q] / resolution and value_at(
                    floor, row + step * vr, col + step * vc
                ):
                    value = value_at(clearance, row + step * vr, col + step * vc)
                    best[q, side] = max(best[q, side], value)
                    step += 1
    return 2 * min(best[0, 0], best[0, 1]), 2 * min(best[1, 0], best[1, 1])
