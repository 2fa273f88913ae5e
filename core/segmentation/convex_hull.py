"""Convex hulls that are fast for the few points of a region's rim."""

from __future__ import annotations

import numba
import numpy as np

from core.geometry import FloatArray


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
