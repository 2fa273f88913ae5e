"""The extracted regions on the latest map: early maps have fans and gaps that are known better now.

Regions are extracted one after the other, each cut off what was left at that moment. At the end the
whole is known: `revised` chooses all borders together (`convex_grouping.py`), and the regions of the
drive live on as the heirs of their numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy import ndimage

from core.geometry import IntArray
from core.mapping import OccupancyGrid
from core.segmentation.convex_grouping import GroupingConfig, grouped
from core.segmentation.convexity import ConvexityConfig, convexity
from core.segmentation.decision import Decision, measure_cut
from core.segmentation.extraction_state import (
    ExtractedRegion,
    ExtractionState,
    lattice_corner,
    painted,
)
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.label_growth import grown
from core.segmentation.mutual_visibility import sight_blockers
from core.segmentation.small_cells import SmallCellConfig, small_cells


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
    return grown(labels, grid.free, int(reach / grid.geometry.resolution))


@dataclass(frozen=True)
class RevisionConfig:
    """Parameters of the division at the end of a drive.

    Attributes:
        cells: what regions are put together from.
        grouping: what makes regions good.
        least_part: share of a region that another one must have given to be named as its parent.
        seed: of the search for the best regions.
    """

    cells: SmallCellConfig = field(default_factory=SmallCellConfig)
    grouping: GroupingConfig = field(default_factory=GroupingConfig)
    least_part: float = 0.1
    seed: int = 0


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
    state: ExtractionState,
    grid: OccupancyGrid,
    rooms: IntArray,
    config: RevisionConfig,
    counted: ConvexityConfig,
) -> Revision:
    """The regions divided anew on the latest map, as few and as convex as it allows.

    Each region of the new division is the heir of the one that it shares most floor with; what has
    no heir left is a new number. Whoever else gave a part worth naming is named as where it came
    from.

    Args:
        state: the regions as they were extracted.
        grid: the latest map.
        rooms: (rows, cols) suggested rooms on it, 0 = none.
        config: how the division is made.
        counted: how C1 and C2 are counted.
    """
    labels = region_image(state, grid)
    resolution, blocked = grid.geometry.resolution, sight_blockers(grid)
    cells = small_cells(labels > 0, blocked, grid, config.cells)
    rng = np.random.default_rng(config.seed)
    clusters = grouped(cells, rooms, blocked, resolution, config.grouping, rng)
    heirs = _heirs(labels, clusters, config.least_part, state.next_number)
    regions, decisions = [], []
    for cluster, heir in enumerate(heirs, 1):
        mask = clusters == cluster
        before = next((r.parents for r in state.regions if r.number == heir.number), ())
        parents = (*before, *(p for p in heir.parents if p not in before))
        where = np.argwhere(mask) + lattice_corner(grid.geometry)
        regions.append(ExtractedRegion(heir.number, where, parents, is_open=True))
        if heir.parents:
            whole = mask | np.isin(labels, (heir.number, *heir.parents))
            c1 = convexity((whole,), grid, counted)
            measures = measure_cut(mask, whole, c1, grid, counted)
            hidden = hidden_pairs(mask, blocked)
            decisions.append(
                Decision(cluster, measures, hidden, True, heir.why, heir.number, heir.parents)
            )
    following = max([state.next_number, *(region.number + 1 for region in regions)])
    state = replace(state, regions=tuple(regions), next_number=following)
    return Revision(state, clusters, decisions)


@dataclass(frozen=True)
class _Heir:
    """The number of a region of the new division, whom it came from besides, and why."""

    number: int
    parents: tuple[int, ...]
    why: str


def _heirs(labels: IntArray, clusters: IntArray, least: float, following: int) -> list[_Heir]:
    """For clusters 1, 2, ...: the largest common floor gives a number on first, each only once."""
    shared = np.zeros((int(clusters.max(initial=0)) + 1, int(labels.max(initial=0)) + 1), np.int64)
    np.add.at(shared, (clusters.ravel(), labels.ravel()), 1)
    shared[0], shared[:, 0] = 0, 0
    number = np.zeros(len(shared), np.int64)
    for at in np.argsort(-shared, axis=None, kind="stable"):
        cluster, region = np.unravel_index(at, shared.shape)
        if shared[cluster, region] and not number[cluster] and region not in number:
            number[cluster] = region
    heirs = []
    for cluster in range(1, len(shared)):
        parts = shared[cluster] / shared[cluster].sum()
        own = int(number[cluster])
        parents = tuple(int(v) for v in np.flatnonzero(parts >= least) if v != own)
        why = (
            "convex together on the latest map" if own else "cut off: not convex on the latest map"
        )
        heirs.append(_Heir(own or following, parents, why))
        following += not own
    return heirs
