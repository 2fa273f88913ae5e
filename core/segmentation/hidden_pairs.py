"""Convexity that sees thin walls: the share of point pairs of a region that do not see each other.

Unlike eq. (7) it counts what stands between, not how many grids it covers: a wall one grid thick
hides as much as a wardrobe. 0 = every point sees every other, as in a convex region.
"""

from __future__ import annotations

import numba
import numpy as np

from core.geometry import BoolArray, IntArray

DEFAULT_PAIRS = 400
STEP = 0.5
"""Grids between two looks along a line."""


def hidden_pairs(
    mask: BoolArray, blocked: BoolArray, pairs: int = DEFAULT_PAIRS, seed: int = 0
) -> float:
    """Share (0..1) of random pairs of open grids of `mask` whose straight line meets a blocked one.

    Args:
        mask: (rows, cols) the region.
        blocked: (rows, cols) what nobody sees through, usually all grids that are not free.
        pairs: how many pairs are drawn; the standard error is below 0.5 / sqrt(pairs).
        seed: of the draw.
    """
    cells = np.flatnonzero(mask & ~blocked)
    if len(cells) < 2:
        return 0.0
    rng = np.random.default_rng(seed)
    ends = cells[rng.integers(len(cells), size=(2, pairs))]
    start, stop = np.stack(np.divmod(ends, mask.shape[1]), axis=-1)
    return float(_hidden(start, stop, blocked)) / pairs


@numba.njit(cache=True)
def _hidden(start: IntArray, stop: IntArray, blocked: BoolArray) -> int:
    count = 0
    for k in range(len(start)):
        row, col = start[k, 0] + 0.5, start[k, 1] + 0.5
        d_row, d_col = stop[k, 0] - start[k, 0], stop[k, 1] - start[k, 1]
        steps = int(np.hypot(d_row, d_col) / STEP) + 1
        for i in range(1, steps):
            if blocked[int(row + d_row * i / steps), int(col + d_col * i / steps)]:
                count += 1
                break
    return count
