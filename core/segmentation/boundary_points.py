"""Where two labels of an image touch."""

from __future__ import annotations

import numpy as np

from core.geometry import FloatArray, IntArray

Pair = tuple[int, int]


def boundary_points(labels: IntArray) -> dict[Pair, FloatArray]:
    """Middles `[row, col]` (n, 2) between neighbouring cells of two labels, by pair `(low, high)`.

    Args:
        labels: (rows, cols), 0 = none.
    """
    found = []
    for axis in (0, 1):
        lower = labels[:-1] if axis == 0 else labels[:, :-1]
        upper = labels[1:] if axis == 0 else labels[:, 1:]
        row, col = np.nonzero((lower != upper) & (lower > 0) & (upper > 0))
        a, b = lower[row, col], upper[row, col]
        middle = (row + 0.5, col) if axis == 0 else (row, col + 0.5)
        found.append(np.column_stack((np.minimum(a, b), np.maximum(a, b), *middle)))
    table = np.concatenate(found)
    if len(table) == 0:
        return {}
    table = table[np.lexsort((table[:, 3], table[:, 2], table[:, 1], table[:, 0]))]
    first = np.flatnonzero(np.any(np.diff(table[:, :2], axis=0) != 0, axis=1)) + 1
    return {
        (int(part[0, 0]), int(part[0, 1])): np.ascontiguousarray(part[:, 2:])
        for part in np.split(table, first)
    }
