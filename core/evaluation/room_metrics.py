"""How well a segmentation of a map finds its rooms: F1, panoptic quality, over- and undersegmentation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from core.evaluation.clustering import adjusted_rand
from core.geometry import BoolArray, FloatArray, IntArray

SMALLEST = 100
"""Rooms and segments of this many cells or fewer are ignored."""
MOSTLY = 0.8
"""Share of an area that counts as nearly all of it."""


@dataclass(frozen=True)
class RoomMetrics:
    """The metrics of one segmentation.

    Attributes:
        f1: rooms found at IoU > 0.5: 2 TP / (segments + rooms); f1_75: at IoU > 0.75.
        pq: panoptic quality: sum of the matched IoUs > 0.5 / ((segments + rooms) / 2).
        ari: adjusted Rand index; cells without a segment are a class of their own.
        over: share of rooms cut into two or more segments.
        under: share of rooms swallowed together with another one.
        segments, rooms: how many.
    """

    f1: float
    f1_75: float
    pq: float
    ari: float
    over: float
    under: float
    segments: int
    rooms: int


def room_metrics(predicted: IntArray, truth: IntArray, free: BoolArray) -> RoomMetrics:
    """Compares two label images (rows, cols; 0 = no room) on the true rooms' free cells.

    Segments and rooms are paired one to one so that the sum of their IoUs is largest.

    Reference: Kirillov et al. (2019) for panoptic quality.
    """
    truth = _renumbered(np.where(free, truth, 0))
    inside = truth > 0
    segments = _renumbered(np.where(inside, predicted, 0))[inside]
    rooms = truth[inside]
    n, m = int(segments.max(initial=0)), int(rooms.max(initial=0))
    if n == 0 or m == 0:
        return RoomMetrics(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, n, m)
    counts = np.bincount(segments * (m + 1) + rooms, minlength=(n + 1) * (m + 1))
    table: FloatArray = counts.reshape(n + 1, m + 1).astype(np.float64)
    shared, of_segment, of_room = table[1:, 1:], table.sum(axis=1)[1:], table.sum(axis=0)[1:]
    iou = shared / (of_segment[:, None] + of_room[None, :] - shared)
    matched = iou[linear_sum_assignment(-iou)]
    found = matched > 0.5
    return RoomMetrics(
        f1=2 * float(found.sum()) / (n + m),
        f1_75=2 * float((matched > 0.75).sum()) / (n + m),
        pq=2 * float(matched[found].sum()) / (n + m),
        ari=adjusted_rand(segments, rooms),
        over=_gathered(shared, of_segment[:, None], of_room) / m,
        under=_swallowed(shared, of_room[None, :], of_segment) / m,
        segments=n,
        rooms=m,
    )


def _renumbered(labels: IntArray) -> IntArray:
    """Labels 1.. without gaps, without those of SMALLEST cells or fewer."""
    count = np.bincount(labels.ravel())
    keep = count > SMALLEST
    keep[0] = False
    renumber = np.zeros(len(count), np.int64)
    renumber[keep] = np.arange(1, keep.sum() + 1)
    return renumber[labels]


def _gathered(shared: FloatArray, of_segment: FloatArray, of_room: FloatArray) -> int:
    """Rooms that two or more segments, each mostly inside, nearly fill."""
    mostly = shared >= MOSTLY * of_segment
    filled = np.where(mostly, shared, 0.0).sum(axis=0)
    return int(((mostly.sum(axis=0) >= 2) & (filled >= MOSTLY * of_room)).sum())


def _swallowed(shared: FloatArray, of_room: FloatArray, of_segment: FloatArray) -> int:
    """Rooms that lie, with another one, mostly in a segment which they nearly fill."""
    mostly = shared >= MOSTLY * of_room
    filled = np.where(mostly, shared, 0.0).sum(axis=1)
    several = (mostly.sum(axis=1) >= 2) & (filled >= MOSTLY * of_segment)
    return int(mostly.sum(axis=1)[several].sum())
