"""Autonomous extraction of regions while the robot drives (paper, 3.2), as it works by default.

The frame is the paper's: the space that is not extracted yet is divided tentatively; a part that is
convex and far from the robot is extracted and left alone until the robot is back in it. What
differs, and why (measured: eq. 7 with thin walls hardly ever exceeds 0.2):

- the measure of convexity is the share of hidden pairs, which sees thin walls;
- the tentative division is that of automatic segmentation (`automatic.py`), which knows doorways,
  instead of one normalized cut in two; it divides only the space around the robot that is left;
- a part whose rim is still unexplored waits: it would change right after its extraction;
- extracted regions are re-intersected with the latest map, so that early errors do not stay.

A step is a function of the state and the map at that moment. The caller takes steps at fixed
distances of the drive, so that logs may be cut anywhere.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping import GridGeometry, OccupancyGrid
from core.mapping.occupancy_grid import UNKNOWN
from core.segmentation.automatic import AutomaticConfig, Segmentation, segment_automatically
from core.segmentation.convexity import ConvexityConfig, convexity
from core.segmentation.decision import Decision, measure_cut
from core.segmentation.extraction_state import (
    ExtractedRegion,
    ExtractionState,
    lattice_corner,
    painted,
)
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.moment import Moment


@dataclass(frozen=True)
class AutonomousConfig:
    """Parameters of autonomous extraction.

    Attributes:
        step: metres of travel between two steps.
        window: metres of travel that the local map holds; None takes all data so far.
        most_hidden: share of hidden pairs that a region may have (c_t of eq. 9).
        least_distance: metres between the robot and a part that is extracted.
        most_frontier: share of a part's rim that may be unexplored.
        least_area: square metres of a part.
        least_overlap: share of a reopened region that a part must cover to be its heir.
        convexity: how C1 and C2 are counted, which the history tells beside the hidden pairs.
        automatic: of the tentative division.
    """

    step: float = 2.5
    window: float | None = None
    most_hidden: float = 0.2
    least_distance: float = 2.0
    most_frontier: float = 0.1
    least_area: float = 1.5
    least_overlap: float = 0.5
    convexity: ConvexityConfig = field(default_factory=ConvexityConfig)
    automatic: AutomaticConfig = field(default_factory=AutomaticConfig)


def extract(
    state: ExtractionState, moment: Moment, config: AutonomousConfig | None = None
) -> ExtractionState:
    """One step: extracts every part of the remaining space that is ready."""
    config = config or AutonomousConfig()
    grid, geometry = moment.grid, moment.grid.geometry
    robot = _nearest_free(grid, geometry.cell_of(moment.pose[:2]))
    if robot is None:
        return _recorded(state, moment, None, [], config, "nothing is free yet")
    state, said = _reopened(state, geometry, robot)
    left = _remaining(state, grid, robot)
    if not left.any():
        return _recorded(state, moment, None, [], config, "no space is left around the robot")
    if hidden_pairs(left, ~grid.free) <= config.most_hidden:
        said += "all that is left around the robot can be seen from within"
        return _recorded(state, moment, left.astype(np.int64), [], config, said)
    found = _divided(grid, left, config.automatic).regions
    c1 = convexity((left,), grid, config.convexity)
    distance = np.hypot(*(np.indices(left.shape) - robot[:, None, None])) * geometry.resolution
    here = int(found[tuple(robot)])
    parts = [int(v) for v in np.unique(found[found > 0]) if v != here]
    decisions = []
    for value in sorted(parts, key=lambda v: -float(distance[found == v].min())):
        mask = found == value
        hidden, why = _fitness(mask, grid, distance, config)
        measures = measure_cut(mask, left, c1, grid, config.convexity)
        decision = Decision(value, measures, hidden, not why, why or "convex and explored")
        if decision.accepted:
            state, region = _with_region(state, mask, geometry, config)
            decision = replace(decision, region=region.number, came_from=region.parents)
        decisions.append(decision)
    return _recorded(state, moment, found, decisions, config, said + _summary(decisions))


def finish(
    state: ExtractionState, moment: Moment, config: AutonomousConfig | None = None
) -> ExtractionState:
    """The end of a drive (for now): what is left of reliable free space becomes regions too.

    They stay open: a drive that goes on divides them anew, and heirs keep their numbers.
    """
    config = config or AutonomousConfig()
    grid = moment.grid
    left = _remaining(state, grid, None)
    found = _divided(grid, left, config.automatic).regions if left.any() else None
    decisions = []
    if found is not None:
        c1 = convexity((left,), grid, config.convexity)
        for value in np.unique(found[found > 0]):
            mask = found == value
            large = bool(mask.sum() * grid.geometry.cell_area >= config.least_area)
            decision = Decision(
                int(value),
                measure_cut(mask, left, c1, grid, config.convexity),
                hidden_pairs(mask, ~grid.free),
                large,
                "end of the drive" if large else "too small: joins a neighbour",
            )
            if large:
                state, region = _with_region(state, mask, grid.geometry, config, is_open=True)
                decision = replace(decision, region=region.number, came_from=region.parents)
            decisions.append(decision)
    said = "end of the drive: " + _summary(decisions)
    state = _recorded(state, moment, found, decisions, config, said)
    return replace(state, regions=tuple(r for r in state.regions if len(r.cells)))


def _recorded(
    state: ExtractionState,
    moment: Moment,
    clusters: IntArray | None,
    decisions: list[Decision],
    config: AutonomousConfig,
    said: str,
) -> ExtractionState:
    """The state with the step in its history."""
    if clusters is None:
        clusters = np.zeros(moment.grid.geometry.shape, np.int64)
    thresholds = {
        "hidden_pairs": config.most_hidden,
        "distance_m": config.least_distance,
        "area_m2": config.least_area,
        "unexplored_rim": config.most_frontier,
    }
    return state.recorded(moment, clusters, decisions, thresholds, said)


def _summary(decisions: list[Decision]) -> str:
    """What came of the parts, in words."""
    if not decisions:
        return "the space that is left is one part, the robot is in it"
    taken = [str(d.region) for d in decisions if d.accepted]
    waiting = len(decisions) - len(taken)
    said = f"extracted {', '.join(taken)}" if taken else "nothing extracted"
    return f"{said}; {waiting} part{'s' * (waiting != 1)} not ready" if waiting else said


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


def _nearest_free(grid: OccupancyGrid, cell: IntArray) -> IntArray | None:
    """The free cell nearest to a cell."""
    free = np.argwhere(grid.free)
    if len(free) == 0:
        return None
    return np.asarray(free[((free - cell) ** 2).sum(axis=1).argmin()])


def _reopened(
    state: ExtractionState, geometry: GridGeometry, robot: IntArray
) -> tuple[ExtractionState, str]:
    """The state with the region that the robot is back in open again, and that in words."""
    here = int(painted(state.regions, geometry)[tuple(robot)])
    if not any(r.number == here and not r.is_open for r in state.regions):
        return state, ""
    regions = tuple(replace(r, is_open=True) if r.number == here else r for r in state.regions)
    return replace(state, regions=regions), f"the robot is back in region {here}; "


def _remaining(state: ExtractionState, grid: OccupancyGrid, robot: IntArray | None) -> BoolArray:
    """Free space that no closed region holds; only the part around the robot when that is given."""
    closed = tuple(region for region in state.regions if not region.is_open)
    left = grid.free & (painted(closed, grid.geometry) == 0)
    if robot is None:
        return np.asarray(left)
    pieces, _ = ndimage.label(left)
    here = pieces[tuple(robot)]
    return np.asarray((pieces == here) & (here > 0))


def _divided(grid: OccupancyGrid, left: BoolArray, config: AutomaticConfig) -> Segmentation:
    """Automatic segmentation of a part of the free space, the rest taken as unknown."""
    box = ndimage.find_objects(left.astype(np.int64))[0]
    box = tuple(slice(max(0, s.start - 1), s.stop + 1) for s in box)
    state = np.where(grid.free & ~left, UNKNOWN, grid.state)[box].astype(np.uint8)
    part = OccupancyGrid(
        GridGeometry(grid.geometry.resolution, (0.0, 0.0, 0.0), state.shape), state
    )
    found = segment_automatically(part, config)
    regions, rooms = np.zeros(left.shape, np.int64), np.zeros(left.shape, np.int64)
    regions[box], rooms[box] = found.regions, found.rooms
    return Segmentation(regions, rooms, found.history)


def _fitness(
    mask: BoolArray, grid: OccupancyGrid, distance: FloatArray, config: AutonomousConfig
) -> tuple[float, str]:
    """Hidden pairs of a part and why it is not extracted ("" when it is)."""
    hidden = hidden_pairs(mask, ~grid.free)
    if mask.sum() * grid.geometry.cell_area < config.least_area:
        return hidden, "too small"
    if float(distance[mask].min()) < config.least_distance:
        return hidden, "the robot is still near"
    if hidden > config.most_hidden:
        return hidden, "not convex"
    rim = ndimage.binary_dilation(mask) & ~mask
    if float(grid.unknown[rim].mean()) > config.most_frontier:
        return hidden, "its rim is not explored yet"
    return hidden, ""


def _with_region(
    state: ExtractionState,
    mask: BoolArray,
    geometry: GridGeometry,
    config: AutonomousConfig,
    is_open: bool = False,
) -> tuple[ExtractionState, ExtractedRegion]:
    """The state with a part extracted: the heir of an open region that it covers, or a new one."""
    cells = np.argwhere(mask) + lattice_corner(geometry)
    waiting = tuple(region for region in state.regions if region.is_open)
    numbers = painted(waiting, geometry)[mask]
    parents, heir = [], None
    for region in waiting:
        shared = int((numbers == region.number).sum())
        if shared >= config.least_overlap * len(region.cells) and heir is None:
            heir = region.number
        if shared:
            parents.append(region.number)
    regions = tuple(_without(region, cells) for region in state.regions if region.number != heir)
    regions = tuple(r for r in regions if len(r.cells))
    lineage = tuple(p for p in parents if p != heir)
    number = state.next_number if heir is None else heir
    new = ExtractedRegion(number, cells, lineage, is_open)
    following = state.next_number + (heir is None)
    return replace(state, regions=(*regions, new), next_number=following), new


def _without(region: ExtractedRegion, cells: IntArray) -> ExtractedRegion:
    """An open region without cells that another one has taken."""
    if not region.is_open:
        return region
    low = np.minimum(region.cells.min(axis=0), cells.min(axis=0))
    span = int(max(region.cells[:, 1].max(), cells[:, 1].max()) - low[1]) + 1
    keys = [(c[:, 0] - low[0]) * span + c[:, 1] - low[1] for c in (region.cells, cells)]
    return replace(region, cells=region.cells[~np.isin(*keys)])
