"""Agreement of two labelings."""

from __future__ import annotations

import numpy as np

from core.geometry import AnyArray, FloatArray


def contingency(first: AnyArray, second: AnyArray) -> FloatArray:
    """How often the k-th value of one labeling (N,) meets the l-th of the other."""
    _, a = np.unique(first, return_inverse=True)
    _, b = np.unique(second, return_inverse=True)
    if not len(a):
        return np.zeros((0, 0))
    shape = (int(a.max()) + 1, int(b.max()) + 1)
    return np.bincount(a * shape[1] + b, minlength=shape[0] * shape[1]).reshape(shape).astype(float)


def adjusted_rand(first: AnyArray, second: AnyArray) -> float:
    """Adjusted Rand index of two labelings (N,): 1 = the same, 0 = as by chance.

    Reference: Hubert and Arabie (1985).
    """
    table = contingency(first, second)
    total = table.sum()
    if total < 2:
        return 1.0
    together, of_first, of_second = (
        _pairs(table),
        _pairs(table.sum(axis=1)),
        _pairs(table.sum(axis=0)),
    )
    by_chance = of_first * of_second / _pairs(np.array([total]))
    best = (of_first + of_second) / 2
    return (
        1.0 if abs(best - by_chance) < 1e-12 else float((together - by_chance) / (best - by_chance))
    )


def _pairs(counts: FloatArray) -> float:
    return float((counts * (counts - 1) / 2).sum())
