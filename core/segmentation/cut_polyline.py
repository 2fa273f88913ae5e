"""The line along which two regions touch, as polylines that can be drawn."""

from __future__ import annotations

import numpy as np
from skimage.measure import approximate_polygon

from core.geometry import BoolArray, FloatArray
from core.segmentation.boundary_points import boundary_points

LONGEST_STEP = 1.5
"""Grids between two points of one line: neighbours on a staircase are at most 1 apart."""
TOLERANCE = 0.75
"""Grids by which a drawn line may leave the staircase of grids."""


def cut_polylines(first: BoolArray, second: BoolArray) -> tuple[list[FloatArray], int]:
    """The stretches of contact of two masks (rows, cols), and how many pairs of grids touch.

    Returns:
        Polylines (n, 2) `[row, col]`, one a stretch.
    """
    points = boundary_points(first.astype(np.int64) + 2 * second).get((1, 2))
    if points is None:
        return [], 0
    return [_simplified(line) for line in _chained(points)], len(points)


def _simplified(line: FloatArray) -> FloatArray:
    if len(line) < 3:
        return line
    return np.asarray(approximate_polygon(line, TOLERANCE))  # type: ignore[no-untyped-call]


def _chained(points: FloatArray) -> list[FloatArray]:
    """Points (n, 2) in the order in which they follow each other, parted where they do not."""
    waiting, lines = points, []
    while len(waiting):
        line = [_end_of(waiting)]
        waiting = _without(waiting, line[0])
        while len(waiting):
            away = np.hypot(*(waiting - line[-1]).T)
            if away.min() > LONGEST_STEP:
                break
            line.append(waiting[int(away.argmin())])
            waiting = np.delete(waiting, int(away.argmin()), axis=0)
        lines.append(np.array(line))
    return lines


def _end_of(points: FloatArray) -> FloatArray:
    """A point at the end of a line: the one farthest from any other."""
    away = ((points - points[0]) ** 2).sum(axis=1)
    return np.asarray(points[int(away.argmax())])


def _without(points: FloatArray, point: FloatArray) -> FloatArray:
    return np.asarray(points[(points != point).any(axis=1)])
