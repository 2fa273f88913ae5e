"""Distance vectors: how far the closest obstacle is in each of 360 directions (eq. 12-13)."""

from __future__ import annotations

import math

import numba
import numpy as np

from core.geometry import BoolArray, FloatArray

DIRECTIONS = 360


def distance_vector(occupied: BoolArray, row: float, col: float, cap: float) -> FloatArray:
    """D(theta) of eq. (12) from a point of a grid: (360,) in grids; index = degrees.

    Args:
        occupied: (rows, cols).
        row, col: the point in grids, fractions allowed; a grid's centre is at whole numbers.
        cap: distance where there is no obstacle (the paper does not say); longer ones are cut.
    """
    return _rays(occupied, row, col, cap)


def dissimilarity(template: FloatArray, place: FloatArray) -> tuple[float, int]:
    """Delta D of eq. (13) between two vectors (360,) and theta_c in degrees.

    The printed `argmin` of eq. (13) is read as: Delta D is the minimum, theta_c where it is taken.
    Vectors are cyclic. theta_c is how far the template must be turned back to lie like the place:
    a direction phi of the place is direction phi + theta_c of the template.
    """
    doubled = np.concatenate((place, place))
    index = (np.arange(DIRECTIONS)[None, :] - np.arange(DIRECTIONS)[:, None]) % DIRECTIONS
    sums = np.abs(template[None, :] - doubled[index]).sum(axis=1)
    turn = int(sums.argmin())
    return float(sums[turn]), turn  # eq. (13)


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _rays(occupied: BoolArray, row: float, col: float, cap: float) -> FloatArray:
    out = np.full(360, cap)
    for degree in range(360):
        d_row, d_col = math.sin(math.radians(degree)), math.cos(math.radians(degree))
        for half in range(int(2 * cap) + 1):
            i = int(math.floor(row + 0.5 * half * d_row + 0.5))
            j = int(math.floor(col + 0.5 * half * d_col + 0.5))
            if 0 <= i < occupied.shape[0] and 0 <= j < occupied.shape[1] and occupied[i, j]:
                out[degree] = min(math.hypot(i - row, j - col), cap)
                break
    return out
