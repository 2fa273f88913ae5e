"""Quadtree cell decomposition of free space (paper, 3.1.1) and its affinity (eq. 3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from core.geometry import BoolArray, FloatArray, IntArray


@dataclass(frozen=True)
class CellDecomposition:
    """Square cells that together cover a mask exactly.

    Attributes:
        row, col: (n,) lowest grid of each cell.
        size: (n,) side in grids, a power of two.
        index: (rows, cols) cell of each grid, -1 outside the mask.
    """

    row: IntArray
    col: IntArray
    size: IntArray
    index: IntArray

    def __len__(self) -> int:
        return len(self.size)

    @property
    def area(self) -> FloatArray:
        """(n,) number of grids of each cell."""
        return np.asarray(self.size.astype(float) ** 2)


def decompose(mask: BoolArray, max_size: int | None = None) -> CellDecomposition:
    """Divides the grid into four again and again until every cell is all inside or all outside.

    Args:
        mask: (rows, cols) the space to decompose, usually the free grids.
        max_size: cells are not larger than this side in grids (a power of two); None as in the
            paper.
    """
    levels = max(1, int(np.ceil(np.log2(max(mask.shape)))))
    if max_size is not None:
        levels = min(levels, int(np.log2(max_size)))
    side = 2**levels
    padded = np.pad(mask, [(0, -n % side) for n in mask.shape])
    full = [padded]
    for _ in range(levels):
        m = full[-1]
        full.append(m[::2, ::2] & m[1::2, ::2] & m[::2, 1::2] & m[1::2, 1::2])
    index = np.full(padded.shape, -1, np.int64)
    found: list[IntArray] = []
    taken = np.zeros(full[-1].shape, bool)
    count = 0
    for level in range(levels, -1, -1):
        cells = np.argwhere(full[level] & ~taken)
        step = 2**level
        blocks = index.reshape(padded.shape[0] // step, step, padded.shape[1] // step, step)
        blocks[cells[:, 0], :, cells[:, 1], :] = (count + np.arange(len(cells)))[:, None, None]
        count += len(cells)
        found.append(np.column_stack((cells * step, np.full(len(cells), step))))
        if level:
            taken = np.repeat(np.repeat(full[level] | taken, 2, axis=0), 2, axis=1)
    table = np.concatenate(found).astype(np.int64)
    return CellDecomposition(
        table[:, 0], table[:, 1], table[:, 2], index[: mask.shape[0], : mask.shape[1]]
    )


def affinity(cells: CellDecomposition) -> sparse.csr_array:
    """W of eq. (3): the number of adjacent grids between two cells, 0 where they do not touch."""
    index, n = cells.index, len(cells)
    pairs = np.concatenate((_borders(index[:, :-1], index[:, 1:]), _borders(index[:-1], index[1:])))
    both = np.concatenate((pairs, pairs[:, ::-1]))
    ones = np.ones(len(both))
    return sparse.csr_array(sparse.coo_array((ones, (both[:, 0], both[:, 1])), shape=(n, n)))


def _borders(one: IntArray, other: IntArray) -> IntArray:
    """The cells (n, 2) of grids and of their neighbours, where these are two."""
    parted = (one != other) & (one >= 0) & (other >= 0)
    return np.column_stack((one[parted], other[parted]))
