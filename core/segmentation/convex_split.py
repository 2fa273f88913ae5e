"""Cutting a region until each part is one place: hidden pairs at most 0.2 (after eq. 7-9).

Like the offline method a normalized cut of quadtree cells in two, again and again; what changes is
the reason to stop, which is no number of regions but convexity that sees thin walls. The second
eigenvector is swept for the prefix with the least normalized cut (Shi and Malik, 2000) instead of
k-means, with the cell's area as its volume, so that many small cells along walls do not count more
than the room between them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import ndimage, sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import eigsh

from core.geometry import BoolArray, FloatArray, IntArray
from core.segmentation.cell_decomposition import affinity, decompose
from core.segmentation.hidden_pairs import hidden_pairs

Box = tuple[slice, slice]
SHIFT = -1e-5
"""Of the inverse iteration, below the smallest eigenvalue 0."""
DENSE_BELOW = 32


@dataclass(frozen=True)
class ConvexSplitConfig:
    """When to cut.

    Attributes:
        most_hidden: share of hidden pairs up to which a region is one place (the paper's c_t).
        pairs: pairs that are drawn.
        least_area: square metres; no part is smaller.
        least_gain: share by which a cut must lower the hidden pairs (0.5 in eq. 9).
        max_cell: largest quadtree cell in grids.
    """

    most_hidden: float = 0.2
    pairs: int = 1000
    least_area: float = 1.0
    least_gain: float = 0.1
    max_cell: int = 16


@dataclass(frozen=True)
class TwoWayCut:
    """A cut in two: `near` and `far` masks, its normalized cut and the middle of its line (cells)."""

    first: BoolArray
    second: BoolArray
    ncut: float
    width: float


def split_until_convex(
    region: BoolArray,
    blocked: BoolArray,
    resolution: float,
    config: ConvexSplitConfig,
    history: list[dict[str, Any]],
    seed: int = 0,
) -> Iterator[BoolArray]:
    """The parts (masks) of a connected region (rows, cols), each seen whole from within, one by one.

    Args:
        region: the region.
        blocked: what nobody sees through.
        resolution: metres per cell.
        config: when to cut.
        history: gets one entry for each decision.
        seed: of the drawn pairs.
    """
    first, box = _boxed(region, (0, 0))
    waiting = [(first, box, hidden_pairs(first, blocked[box], config.pairs, seed))]
    while waiting:
        mask, box, hidden = waiting.pop()
        cut = None
        if hidden > config.most_hidden and mask.sum() * resolution**2 >= 2 * config.least_area:
            cut = two_way_cut(mask, config.least_area / resolution**2, config.max_cell)
        if cut is None:
            yield _whole(mask, box, region.shape)
            continue
        parts = (cut.first, cut.second)
        shares = [hidden_pairs(part, blocked[box], config.pairs, seed) for part in parts]
        after = _mean(shares, parts)
        accepted = after <= (1 - config.least_gain) * hidden
        history.append(
            {
                "event": "split",
                "hidden_pairs": round(hidden, 3),
                "hidden_pairs_after": round(after, 3),
                "ncut": round(cut.ncut, 4),
                "cut_width_m": round(cut.width * resolution, 2),
                "area_m2": round(float(mask.sum()) * resolution**2, 2),
                "accepted": accepted,
                "reason": "parts see more of themselves" if accepted else "too little gained",
            }
        )
        if accepted:
            corner = box[0].start, box[1].start
            boxed = (_boxed(part, corner) for part in parts)
            waiting += [(*part, share) for part, share in zip(boxed, shares, strict=True)]
        else:
            yield _whole(mask, box, region.shape)


def _boxed(mask: BoolArray, corner: tuple[int, int]) -> tuple[BoolArray, Box]:
    """What a mask with its lowest cell at `corner` holds, and the box around that."""
    in_row, in_col = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    rows, cols = slice(in_row[0], in_row[-1] + 1), slice(in_col[0], in_col[-1] + 1)
    row, col = corner
    box = slice(row + rows.start, row + rows.stop), slice(col + cols.start, col + cols.stop)
    return mask[rows, cols], box


def _whole(part: BoolArray, box: Box, shape: tuple[int, ...]) -> BoolArray:
    """The mask (rows, cols) of which a box holds this part."""
    mask = np.zeros(shape, bool)
    mask[box] = part
    return mask


def _mean(shares: list[float], parts: tuple[BoolArray, ...]) -> float:
    """The shares of parts, weighted by their areas."""
    area = np.array([part.sum() for part in parts], float)
    return float((area * np.array(shares)).sum() / area.sum())


def two_way_cut(mask: BoolArray, least: float, max_cell: int) -> TwoWayCut | None:
    """The best cut of a region in two connected parts of at least so many grids; None if there is none."""
    part, box = _boxed(mask, (0, 0))
    cells = decompose(part, max_cell)
    if len(cells) < 2:
        return None
    weights = affinity(cells)
    order = np.argsort(_second_eigenvector(weights, cells.area), kind="stable")
    prefix = _best_prefix(weights, cells.area, order, least)
    if prefix is None:
        return None
    side = np.zeros(len(cells), bool)
    side[order[:prefix]] = True
    first = np.where(cells.index >= 0, side[cells.index], False)
    first, second = _connected(part, first)
    if min(first.sum(), second.sum()) < least:
        return None
    cut = _crossing(first, second)
    area = np.array([first.sum(), second.sum()], float)
    near, far = (_whole(half, box, mask.shape) for half in (first, second))
    return TwoWayCut(near, far, float((cut / area).sum()), float(cut))


def _second_eigenvector(weights: sparse.csr_array, area: FloatArray) -> FloatArray:
    """Of (D - W) y = lambda A y with the areas A as volumes; the sign is fixed."""
    n = len(area)
    laplacian = _scaled_laplacian(weights, 1 / np.sqrt(area))
    if n <= DENSE_BELOW:
        vector = np.linalg.eigh(laplacian.toarray())[1][:, 1]
    else:
        start = np.sqrt(area) + np.arange(n) / n
        values, vectors = eigsh(laplacian, 2, sigma=SHIFT, v0=start)
        vector = vectors[:, values.argmax()]
    vector = vector / np.sqrt(area)
    return np.asarray(-vector if vector[np.abs(vector).argmax()] < 0 else vector)


def _scaled_laplacian(weights: sparse.csr_array, scale: FloatArray) -> sparse.csc_array:
    """S (D - W) S with S = diag(scale), entry by entry: products of sparse matrices take as long as
    the eigenvectors."""
    laplacian = csgraph.laplacian(weights).tocoo()
    value = scale[laplacian.row] * laplacian.data * scale[laplacian.col]
    return sparse.csc_array((value, (laplacian.row, laplacian.col)), shape=laplacian.shape)


def _best_prefix(
    weights: sparse.csr_array, area: FloatArray, order: IntArray, least: float
) -> int | None:
    """How many cells of the order make the first part of the least normalized cut."""
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    coo = weights.tocoo()
    low = np.minimum(rank[coo.row], rank[coo.col])
    high = np.maximum(rank[coo.row], rank[coo.col])
    change = np.bincount(low, coo.data / 2, len(order)) - np.bincount(
        high, coo.data / 2, len(order)
    )
    cut = np.cumsum(change)[:-1]
    first = np.cumsum(area[order])[:-1]
    second = area.sum() - first
    allowed = (first >= least) & (second >= least)
    if not allowed.any():
        return None
    value = np.where(allowed, cut / first + cut / second, np.inf)
    return int(value.argmin()) + 1


def _connected(whole: BoolArray, first: BoolArray) -> tuple[BoolArray, BoolArray]:
    """Both sides in one piece: smaller pieces of a side go over to the other."""
    for _ in range(2):
        labels, count = ndimage.label(first)
        if count > 1:
            sizes = np.bincount(labels.ravel())
            sizes[0] = 0
            first = labels == sizes.argmax()
        first = whole & ~first
    return first, whole & ~first


def _crossing(first: BoolArray, second: BoolArray) -> int:
    """Grids along the cut."""
    return int(
        (first[1:] & second[:-1]).sum()
        + (second[1:] & first[:-1]).sum()
        + (first[:, 1:] & second[:, :-1]).sum()
        + (second[:, 1:] & first[:, :-1]).sum()
    )
