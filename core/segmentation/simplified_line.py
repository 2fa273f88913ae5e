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
        d_row, d_col = points[end] - points[start]
        angle = -math.atan2(d_row, d_col)
        cos, sin = math.cos(angle), math.sin(angle)
        level = col * sin + row * cos
        farthest, most = -1, tolerance
        for k in range(start + 1, end):
            r, c = points[k] - points[start]
            back_r, back_c = points[k] - points[end]
            if r * d_row + c * d_col > 0 and -back_r * d_row - back_c * d_col > 0:
                away = abs(points[k, 0] * cos + points[k, 1] * sin - level)
            else:
                away = math.sqrt(min(r * r + c * c, back_r * back_r + back_c * back_c))
            if away > most:
                farthest, most = k, away
        if farthest >= 0:
            kept[farthest] = True
            waiting.append((farthest, end))
            waiting.append((start, farthest))
    return kept
