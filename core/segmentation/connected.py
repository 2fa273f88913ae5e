"""Regions are connected: what becomes of the pieces of a region that is not.

Decision: the largest piece stays the region; every other piece joins the region with which it
shares the longest border. So the number of regions stays as it was and no floor is lost.
"""

from __future__ import annotations

import numba
import numpy as np
from scipy import ndimage
from skimage.segmentation import watershed

from core.geometry import BoolArray, IntArray


def largest_component(mask: BoolArray, seeds: IntArray | None = None) -> BoolArray:
    """The 4-connected part of a mask that holds most of the seeds, or the largest one.

    Args:
        mask: (rows, cols).
        seeds: (n, 2) cells `[row, col]` inside the grid, or None.
    """
    labels, count = ndimage.label(mask)
    if count <= 1:
        return np.asarray(labels > 0)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    if seeds is not None and len(seeds):
        votes = np.bincount(labels[seeds[:, 0], seeds[:, 1]], minlength=count + 1)
        votes[0] = 0
        if votes.any():
            return np.asarray(labels == votes.argmax())
    return np.asarray(labels == sizes.argmax())


def reachable_floor(free: BoolArray, seeds: IntArray, half_width: float) -> BoolArray:
    """Free space that hangs together by passages wide enough, around where the robot has been.

    Sonar maps leak: a fan of false free space behind a wall hangs on the room by a crack. Free space
    is parted at its cracks (watershed of the clearance), and the parts that hold a seed are kept.

    Args:
        free: (rows, cols) mask.
        seeds: (n, 2) cells `[row, col]` where the robot has been, inside the grid.
        half_width: half the width in cells of the narrowest passage.
    """
    clearance = ndimage.distance_transform_edt(free)
    cores, count = ndimage.label(clearance > half_width)
    if count == 0 or len(seeds) == 0:
        return largest_component(free, seeds)
    parts = watershed(-clearance, cores, mask=free)  # type: ignore[no-untyped-call]
    visited = np.unique(parts[seeds[:, 0], seeds[:, 1]])
    kept = np.isin(parts, visited[visited > 0])
    return largest_component(kept if kept.any() else free, seeds)


def border_lengths(labels: IntArray) -> dict[tuple[int, int], int]:
    """How many pairs of neighbouring grids two labels share, for each pair `(low, high)`."""
    pairs = np.concatenate(
        (
            np.column_stack((labels[:, :-1].ravel(), labels[:, 1:].ravel())),
            np.column_stack((labels[:-1].ravel(), labels[1:].ravel())),
        )
    )
    pairs = pairs[(pairs[:, 0] > 0) & (pairs[:, 1] > 0) & (pairs[:, 0] != pairs[:, 1])]
    unique, count = np.unique(np.sort(pairs, axis=1), axis=0, return_counts=True)
    return {(int(a), int(b)): int(n) for (a, b), n in zip(unique, count, strict=True)}


def connect_regions(regions: IntArray) -> IntArray:
    """The same regions with every one in a single 4-connected piece."""
    out = regions.copy()
    pieces: list[BoolArray] = []
    for value in np.unique(regions[regions > 0]):
        labels, count = ndimage.label(regions == value)
        if count > 1:
            sizes = np.bincount(labels.ravel())[1:]
            keep = int(sizes.argmax()) + 1
            pieces += [labels == i for i in range(1, count + 1) if i != keep]
    for piece in pieces:
        out[piece] = 0
    return given_to_neighbours(out, sorted(pieces, key=lambda piece: -int(piece.sum())))


def given_to_neighbours(regions: IntArray, pieces: list[BoolArray]) -> IntArray:
    """The regions with each piece in the one with the longest border to it.

    Pieces that touch none wait for their neighbours; those that never touch one have no region.
    """
    regions, waiting = regions.copy(), pieces
    while waiting:
        left = []
        for piece in waiting:
            around = ndimage.binary_dilation(piece) & (regions > 0)
            if around.any():
                regions[piece] = np.bincount(regions[around]).argmax()
            else:
                left.append(piece)
        if len(left) == len(waiting):
            break
        waiting = left
    return regions


def renumber(regions: IntArray) -> IntArray:
    """The same regions with values 1..n, from the lowest row upwards, left to right."""
    table = np.zeros(int(regions.max(initial=0)) + 1, np.int64)
    _number(regions, table)
    return np.asarray(table[regions])


@numba.njit(cache=True)
def _number(regions: IntArray, table: IntArray) -> None:
    """Gives the values of an image numbers 1..n in the order in which they come first."""
    count = 0
    for value in regions.flat:
        if value > 0 and table[value] == 0:
            count += 1
            table[value] = count
