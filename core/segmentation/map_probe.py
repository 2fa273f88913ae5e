"""Looking at a map from a point and along a line; compiled, for the loops that measure borders."""

from __future__ import annotations

import numba


@numba.njit(cache=True)
def value_at(image, row, col):  # type: ignore[no-untyped-def]
    """The cell of a (rows, cols) image nearest to a point, 0 outside."""
    i, j = int(round(row)), int(round(col))
    if i < 0 or j < 0 or i >= image.shape[0] or j >= image.shape[1]:
        return image.dtype.type(0)
    return image[i, j]


@numba.njit(cache=True)
def free_run(floor, row, col, dr, dc, most):  # type: ignore[no-untyped-def]
    """Steps that can be made on the floor from a point in a direction, at most so many."""
    k = 0
    while k < most and value_at(floor, row + k * dr, col + k * dc):
        k += 1
    return k
