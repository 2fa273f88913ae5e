"""A line of points with fewer corners (Ramer, 1972; Douglas and Peucker, 1973), compiled.

scikit-image has the same; importing that brings in `scipy.signal` and `scipy.stats`, .4 s of processor
time in every process that segments.
"""

from __future__ import annotations

import math

import numba
import numpy as np

from core.geometry import BoolArray, FloatArray


def simplified_line(points: FloatArray, tolerance: float) -> FloatArray:
    """The points (n, 2) of a line, n >= 1, that are needed to stay within a tolerance > 0 of all.

    The ends stay. In between, the farthest point beyond the tolerance from the stretch between two
    that stay stays, too, again and again.
    """
    return np.asarray(points[_needed(np.ascontiguousarray(points, float), tolerance)])


@numba.njit(cache=True)
def _needed(points: FloatArray, tolerance: float) -> BoolArray:
    """Which points (n,) stay."""
    kept = np.zeros(len(points), np.bool_)
    kept[0], kept[-1] = True, True
    waiting = [(0, len(points) - 1)]
    while waiting:
        start, end = waiting.pop()
        row, col = points[start]
        to_row, to_col = points[end]
        d_row, d_col = to_row - row, to_col - col
        angle = -math.atan2(d_row, d_col)
        cos, sin = math.cos(angle), math.sin(angle)
        level = col * sin + row * cos
        farthest, most = -1, tolerance
        for k in range(start + 1, end):
            r, c = points[k]
            from_start = (r - row) * d_row + (c - col) * d_col
            to_end = (to_row - r) * d_row + (to_col - c) * d_col
            if from_start > 0 and to_end > 0:
                away = abs(r * cos + c * sin - level)
            else:
                away = min(math.hypot(r - row, c - col), math.hypot(r - to_row, c - to_col))
            if away > most:
                farthest, most = k, away
        if farthest >= 0:
            kept[farthest] = True
            waiting.append((farthest, end))
            waiting.append((start, farthest))
    return kept
