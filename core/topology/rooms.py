"""Rooms over nodes: which regions have no doorway between them."""

from __future__ import annotations

import numpy as np

from core.geometry import IntArray


def suggested_rooms(regions: IntArray, seen: IntArray) -> IntArray:
    """Label image (rows, cols) of rooms, each a union of the given regions.

    Args:
        regions: (rows, cols), 0 = none.
        seen: (rows, cols) rooms as automatic segmentation sees them on the map; every region goes to
            the one that holds most of it.
    """
    count = int(regions.max(initial=0)) + 1
    inside = (regions > 0) & (seen > 0)
    votes = np.zeros((count, int(seen.max(initial=0)) + 1), np.int64)
    np.add.at(votes, (regions[inside], seen[inside]), 1)
    room = np.where(votes.any(axis=1), votes.argmax(axis=1), 0)
    alone = np.flatnonzero((room == 0) & (np.bincount(regions.ravel(), minlength=count) > 0))
    alone = alone[alone > 0]
    room[alone] = votes.shape[1] + np.arange(len(alone))
    return np.where(regions > 0, np.unique(room, return_inverse=True)[1][regions] + 1, 0)
