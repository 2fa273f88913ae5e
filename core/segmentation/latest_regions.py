"""The extracted regions on the latest map: early maps have fans and gaps that are known better now."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.mapping import OccupancyGrid
from core.segmentation.convex_division import DivisionConfig, divided
from core.segmentation.convex_join import convex_groups
from core.segmentation.convexity import ConvexityConfig, convexity
from core.segmentation.decision import Decision, measure_cut
from core.segmentation.extraction_state import (
    ExtractedRegion,
    ExtractionState,
    lattice_corner,
    painted,
)
from core.segmentation.hidden_pairs import hidden_pairs


def region_image(state: ExtractionState, grid: OccupancyGrid, reach: float = 1.0) -> IntArray:
    """The regions on the latest map (rows, cols), by their numbers.

    Every region is intersected with what is free now and kept in its largest piece; free space
    that no region has and that touches one within the reach (m) joins the nearest.
    """
    labels = np.where(grid.free, painted(state.regions, grid.geometry), 0)
    for region in state.regions:
        pieces, count = ndimage.label(labels == region.number)
        if count > 1:
            sizes = np.bincount(pieces.ravel())
            sizes[0] = 0
            labels[(pieces > 0) & (pieces != sizes.argmax())] = 0
    return _grown(labels, grid.free, int(reach / grid.geometry.resolution))


def _grown(labels: IntArray, free: BoolArray, steps: int) -> IntArray:
    """Labels spread over unlabelled free cells, a cell a step, never through walls."""
    labels = labels.copy()
    for _ in range(steps):
        spread = ndimage.grey_dilation(labels, footprint=ndimage.generate_binary_structure(2, 1))
        new = free & (labels == 0) & (spread > 0)
        if not new.any():
            break
        labels[new] = spread[new]
    return labels


@dataclass(frozen=True)
class Revision:
    """Regions brought up to date with a map.

    Attributes:
        state: the regions as they are now.
        clusters: (rows, cols) the regions as they are now, numbered from 1.
        decisions: one for each region that was cut off another or took others in.
    """

    state: ExtractionState
    clusters: IntArray
    decisions: list[Decision] = field(default_factory=list)


def revised(
    state: ExtractionState, grid: OccupancyGrid, division: DivisionConfig, counted: ConvexityConfig
) -> Revision:
    """Every region on the latest map, cut where it is not convex there, joined where it can be.

    The largest part of a region keeps its number, and of regions that are joined the largest does;
    the others are named as where it came from.

    Args:
        state: the regions as they were extracted.
        grid: the latest map.
        division: when a region is convex.
        counted: how C1 and C2 are counted.
    """
    labels = region_image(state, grid)
    was, number, masks = _cut(labels, grid, division, state.next_number)
    border = round(division.least_border / grid.geometry.resolution)
    groups = convex_groups(masks, ~grid.free, division.most_hidden, division.pairs, border)
    regions, decisions = [], []
    clusters = np.zeros(labels.shape, np.int64)
    for cluster, group in enumerate(groups, 1):
        mask = np.logical_or.reduce([masks[i] for i in group])
        clusters[mask] = cluster
        own = number[group[0]]
        parents = tuple(sorted({was[i] for i in group} - {own}))
        cells = np.argwhere(mask) + lattice_corner(grid.geometry)
        before = next((r.parents for r in state.regions if r.number == own), ())
        regions.append(ExtractedRegion(own, cells, (*before, *parents), is_open=True))
        if parents:
            whole = mask | (labels == was[group[0]])
            c1 = convexity((whole,), grid, counted)
            measures = measure_cut(mask, whole, c1, grid, counted)
            why = "convex together" if len(group) > 1 else "cut off: not convex on the latest map"
            hidden = hidden_pairs(mask, ~grid.free, division.pairs)
            decisions.append(Decision(cluster, measures, hidden, True, why, own, parents))
    following = max([state.next_number, *(n + 1 for n in number)])
    state = replace(state, regions=tuple(regions), next_number=following)
    return Revision(state, clusters, decisions)


def _cut(
    labels: IntArray, grid: OccupancyGrid, division: DivisionConfig, following: int
) -> tuple[list[int], list[int], list[BoolArray]]:
    """All regions cut until convex: the region that each part was, its number now, its mask."""
    was, number, masks = [], [], []
    for value in np.unique(labels[labels > 0]):
        mask = labels == value
        parts = divided(mask, ~grid.free, grid.geometry.resolution, division)
        sizes = np.bincount(parts[mask], minlength=2)
        for part in np.argsort(-sizes[1:], kind="stable") + 1:
            first = part == sizes[1:].argmax() + 1
            was.append(int(value))
            number.append(int(value) if first else following)
            following += not first
            masks.append(parts == part)
    return was, number, masks
