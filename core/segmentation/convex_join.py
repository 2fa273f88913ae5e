"""Making parts one again that are convex together: bisection cuts more often than it must."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.geometry import BoolArray
from core.segmentation.boundary_points import boundary_points
from core.segmentation.hidden_pairs import hidden_pairs


def convex_groups(
    parts: Sequence[BoolArray],
    blocked: BoolArray,
    most_hidden: float,
    pairs: int,
    least_border: int = 1,
    seed: int = 0,
) -> list[list[int]]:
    """Which parts may be one region; the pair that sees most of itself is joined first.

    Args:
        parts: masks (rows, cols) that do not overlap.
        blocked: what nobody sees through.
        most_hidden: share of hidden pairs that a region may have.
        pairs: pairs that are drawn.
        least_border: grids along which two parts must touch.
        seed: of the drawn pairs.

    Returns:
        Groups of indices, the largest part of each group first.
    """
    masks = dict(enumerate(parts))
    groups = {i: [i] for i in masks}
    hidden: dict[tuple[int, int], float] = {}
    labels = np.zeros(blocked.shape, np.int64)
    for i, mask in masks.items():
        labels[mask] = i + 1
    while True:
        touching = {
            (low - 1, high - 1)
            for (low, high), points in boundary_points(labels).items()
            if len(points) >= least_border
        }
        for a, b in touching - set(hidden):
            hidden[a, b] = hidden_pairs(masks[a] | masks[b], blocked, pairs, seed)
        best = min(touching, key=lambda pair: (hidden[pair], pair), default=None)
        if best is None or hidden[best] > most_hidden:
            break
        a, b = best
        masks[a] = masks[a] | masks.pop(b)
        groups[a] += groups.pop(b)
        labels[labels == b + 1] = a + 1
        hidden = {pair: share for pair, share in hidden.items() if a not in pair and b not in pair}
    return [sorted(group, key=lambda i: -int(parts[i].sum())) for group in groups.values()]
