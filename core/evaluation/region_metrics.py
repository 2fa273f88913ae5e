"""How well regions follow the rooms of a home."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from core.evaluation.clustering import adjusted_rand
from core.evaluation.ground_truth import GroundTruth, sampled
from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping.occupancy_grid import GridGeometry

PAIRS = 400
"""Pairs of cells that the hidden share of a region is estimated from."""


@dataclass(frozen=True)
class RoomOverlap:
    """How one room was met: IoU of its best single region, and of all regions mostly inside it."""

    best_iou: float
    merged_iou: float


@dataclass(frozen=True)
class RegionMetrics:
    """The metrics of one segmentation, over the free explored floor of the truth.

    Attributes:
        count, rooms_true: number of regions, of rooms.
        coverage: share of the floor that has a region.
        purity: share of it whose region lies mostly in its room.
        ari: adjusted Rand index of region against room.
        rooms: by the name of the room.
        hidden: by region: share of its pairs of free cells whose straight line the truth blocks.
        hidden_mean, hidden_max: over regions, the mean weighted by area.
        smallest_m2: area of the smallest region.
    """

    count: int
    rooms_true: int
    coverage: float
    purity: float
    ari: float
    rooms: Mapping[str, RoomOverlap]
    hidden: Mapping[int, float]
    hidden_mean: float
    hidden_max: float
    smallest_m2: float

    @property
    def best_iou_mean(self) -> float:
        """Mean over rooms of the best single region's IoU."""
        return (
            float(np.mean([room.best_iou for room in self.rooms.values()])) if self.rooms else 0.0
        )

    @property
    def merged_iou_mean(self) -> float:
        """Mean over rooms of the merged regions' IoU."""
        values = [room.merged_iou for room in self.rooms.values()]
        return float(np.mean(values)) if values else 0.0


def region_metrics(
    regions: IntArray, geometry: GridGeometry, truth: GroundTruth, pairs: int = PAIRS
) -> RegionMetrics:
    """Compares a label image of regions (0 = none) with the rooms; both in the same frame."""
    labels = sampled(regions, geometry, truth.centres(), 0).astype(np.int64)
    floor = truth.free & truth.explored & (truth.rooms > 0)
    covered = floor & (labels > 0)
    rooms_true = len(np.unique(truth.rooms[floor]))
    if not covered.any():
        return RegionMetrics(0, rooms_true, 0.0, 0.0, 0.0, {}, {}, 1.0, 1.0, 0.0)
    region, room = labels[covered], truth.rooms[covered]
    ids = np.unique(region)
    pure = sum(int(np.bincount(room[region == k]).max()) for k in ids)
    hidden = {int(k): hidden_share(covered & (labels == k), truth.occupied, pairs) for k in ids}
    cells = {k: int((region == k).sum()) for k in hidden}
    return RegionMetrics(
        count=len(ids),
        rooms_true=rooms_true,
        coverage=float(covered.sum() / floor.sum()),
        purity=pure / len(region),
        ari=adjusted_rand(room, region),
        rooms=_overlaps(labels, covered, floor, truth),
        hidden=hidden,
        hidden_mean=sum(hidden[k] * cells[k] for k in hidden) / sum(cells.values()),
        hidden_max=max(hidden.values()),
        smallest_m2=min(cells.values()) * truth.geometry.cell_area,
    )


def hidden_share(mask: BoolArray, blocking: BoolArray, pairs: int = PAIRS, seed: int = 0) -> float:
    """Share of random pairs of cells of `mask` whose straight line meets a cell of `blocking`."""
    cells = np.argwhere(mask)
    if len(cells) < 2:
        return 0.0
    rng = np.random.default_rng(seed)
    starts = cells[rng.integers(len(cells), size=pairs)] + 0.5
    ends = cells[rng.integers(len(cells), size=pairs)] + 0.5
    return float(np.mean([_is_blocked(a, b, blocking) for a, b in zip(starts, ends, strict=True)]))


def _is_blocked(start: FloatArray, end: FloatArray, blocking: BoolArray) -> bool:
    """Whether points half a cell apart on the line from `start` to `end` meet a blocking cell."""
    steps = int(np.hypot(*(end - start)) / 0.5) + 1
    shares = np.arange(steps + 1)[:, None] / steps
    points = (start + (end - start) * shares).astype(np.int64)
    return bool(blocking[points[:, 0], points[:, 1]].any())


def _overlaps(
    labels: IntArray, covered: BoolArray, floor: BoolArray, truth: GroundTruth
) -> dict[str, RoomOverlap]:
    found = {}
    ids = np.unique(labels[covered])
    for number in np.unique(truth.rooms[floor]):
        room = floor & (truth.rooms == number)
        merged = np.zeros(labels.shape, np.bool_)
        best = 0.0
        for k in ids:
            region = covered & (labels == k)
            shared = int((region & room).sum())
            best = max(best, shared / int((region | room).sum()))
            if shared > 0.5 * region.sum():
                merged |= region
        name = truth.names[number - 1] if number <= len(truth.names) else str(number)
        iou = (merged & room).sum() / (merged | room).sum()
        found[name] = RoomOverlap(best, float(iou))
    return found
