"""Convex hulls that are fast for the few points of a region's rim."""

from __future__ import annotations

import numba
import numpy as np

from core.geometry import BoolArray, FloatArray


@numba.njit(cache=True)
def convex_hull(points: FloatArray) -> FloatArray:
    """Corners (k, 2) of the convex hull of points (n, 2): monotone chain (Andrew, 1979)."""
    n = len(points)
    if n < 3:
        return points.copy()
    order = np.argsort(points[:, 1], kind="mergesort")
    order = order[np.argsort(points[order, 0], kind="mergesort")]
    hull = np.empty((2 * n + 2, 2))
    size = 0
    for half in range(2):
        start = size
        for step in range(n):
            p = points[order[step if half == 0 else n - 1 - step]]
            while size - start >= 2 and _turn(hull[size - 2], hull[size - 1], p) <= 0:
                size -= 1
            hull[size] = p
            size += 1
        size -= 1
    return hull[: max(size, 1)].copy()


@numba.njit(cache=True)
def _turn(a: FloatArray, b: FloatArray, c: FloatArray) -> float:
    """Twice the signed area of a triangle."""
    area: float = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return area


@numba.njit(cache=True)
def polygon_area(corners: FloatArray) -> float:
    """Area of a simple polygon (k, 2), in the square of its unit."""
    twice = 0.0
    for i in range(len(corners)):
        j = (i + 1) % len(corners)
        twice += corners[i, 0] * corners[j, 1] - corners[i, 1] * corners[j, 0]
    return abs(twice) / 2


@numba.njit(cache=True)
def marked_in_hull(corners: FloatArray, mask: BoolArray) -> int:
    """How many marked cells of `mask` (rows, cols) lie in a convex polygon (k, 2), rim included.

    Args:
        corners: `[row, col]` in order, k >= 1; every corner is a cell of the mask.
        mask: what is counted.
    """
    count = 0
    for row in range(int(corners[:, 0].min()), int(corners[:, 0].max()) + 1):
        low, high = np.inf, -np.inf
        for i in range(len(corners)):
            a, b = corners[i], corners[(i + 1) % len(corners)]
            if min(a[0], b[0]) > row or max(a[0], b[0]) < row:
                continue
            if a[0] == b[0]:
                left, right = min(a[1], b[1]), max(a[1], b[1])
            else:
                left = right = a[1] + (row - a[0]) * (b[1] - a[1]) / (b[0] - a[0])
            low, high = min(low, left), max(high, right)
        for col in range(int(np.ceil(low - 1e-9)), int(np.floor(high + 1e-9)) + 1):
            count += mask[row, col]
    return count
