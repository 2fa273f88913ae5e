"""Autonomous extraction of regions while the robot drives (paper, 3.2), as it works by default.

The frame is the paper's: the space that is not extracted yet is divided tentatively; a part that is
convex and far from the robot is extracted and left alone until the robot is back in it. What
differs, and why (measured: eq. 7 with thin walls hardly ever exceeds 0.2):

- the measure of convexity is the share of hidden pairs, which sees thin walls;
- the tentative division goes on until every part is convex (`convex_division.py`), instead of one
  normalized cut in two; it divides only the space around the robot that is left;
- a part whose rim is still unexplored waits: it would change right after its extraction;
- at the end the borders of all regions are chosen together on the latest map (`latest_regions.py`),
  so that early errors do not stay and no more regions are left than convexity asks for.

A step is a function of the state and the map at that moment. The caller takes steps at fixed
distances of the drive, so that logs may be cut anywhere.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping import OccupancyGrid
from core.segmentation.convex_division import DivisionConfig, divided
from core.segmentation.convexity import ConvexityConfig, convexity
from core.segmentation.decision import Decision, measure_cut
from core.segmentation.extraction_state import ExtractionState, painted
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.inheritance import reopened, with_region
from core.segmentation.latest_regions import RevisionConfig, revised
from core.segmentation.moment import Moment
from core.wording import counted


@dataclass(frozen=True)
class AutonomousConfig:
    """Parameters of autonomous extraction.

    Attributes:
        step: metres of travel between two steps.
        window: metres of travel that the local map holds; None takes all data so far.
        least_distance: metres between the robot and a part that is extracted.
        most_frontier: share of a part's rim that may be unexplored.
        convexity: how C1 and C2 are counted, which the history tells beside the hidden pairs.
        division: of the tentative division; its `most_hidden` is c_t of eq. 9.
        revision: of the regions at the end of the drive.
    """

    step: float = 2.5
    window: float | None = None
    least_distance: float = 2.0
    most_frontier: float = 0.1
    convexity: ConvexityConfig = field(default_factory=ConvexityConfig)
    division: DivisionConfig = field(default_factory=DivisionConfig)
    revision: RevisionConfig = field(default_factory=RevisionConfig)


def extract(
    state: ExtractionState, moment: Moment, config: AutonomousConfig | None = None
) -> ExtractionState:
    """One step: extracts every part of the remaining space that is ready."""
    config = config or AutonomousConfig()
    grid, geometry = moment.grid, moment.grid.geometry
    robot = _nearest_free(grid, geometry.cell_of(moment.pose[:2]))
    if robot is None:
        return _recorded(state, moment, None, [], config, "nothing is free yet")
    state, said = reopened(state, geometry, robot)
    left = _remaining(state, grid, robot)
    if not left.any():
        return _recorded(state, moment, None, [], config, "no space is left around the robot")
    found = divided(left, ~grid.free, geometry.resolution, config.division)
    c1 = convexity((left,), grid, config.convexity)
    distance = np.hypot(*(np.indices(left.shape) - robot[:, None, None])) * geometry.resolution
    here = int(found[tuple(robot)])
    parts = [int(v) for v in np.unique(found[found > 0]) if v != here]
    decisions = []
    # The farther cluster first (3.2.2).
    for value in sorted(parts, key=lambda v: -float(distance[found == v].min())):
        mask = found == value
        hidden, why = _fitness(mask, grid, distance, config)
        measures = measure_cut(mask, left, c1, grid, config.convexity)
        decision = Decision(value, measures, hidden, not why, why or "convex and explored")
        if decision.accepted:
            state, region = with_region(state, mask, geometry)
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
    found = divided(left, ~grid.free, grid.geometry.resolution, config.division)
    c1 = convexity((left,), grid, config.convexity)
    decisions = []
    for value in np.unique(found[found > 0]):
        mask = found == value
        large = bool(mask.sum() * grid.geometry.cell_area >= config.division.least_area)
        decision = Decision(
            int(value),
            measure_cut(mask, left, c1, grid, config.convexity),
            hidden_pairs(mask, ~grid.free),
            large,
            "end of the drive" if large else "too small: joins a neighbour",
        )
        if large:
            state, region = with_region(state, mask, grid.geometry, is_open=True)
            decision = replace(decision, region=region.number, came_from=region.parents)
        decisions.append(decision)
    said = "end of the drive: " + _summary(decisions)
    state = _recorded(state, moment, found, decisions, config, said)
    latest = revised(state, grid, moment.rooms, config.revision, config.convexity)
    if not latest.decisions:
        return latest.state
    changed = counted(len(latest.decisions), "region")
    said = f"cut or joined on the map of the whole drive: {changed}"
    goals = config.revision.grouping
    thresholds = {"hidden_pairs": goals.most_hidden, "area_m2": goals.least_area}
    return latest.state.recorded(moment, latest.clusters, latest.decisions, thresholds, said)


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
        "hidden_pairs": config.division.most_hidden,
        "distance_m": config.least_distance,
        "area_m2": config.division.least_area,
        "unexplored_rim": config.most_frontier,
    }
    return state.recorded(moment, clusters, decisions, thresholds, said)


def _summary(decisions: list[Decision]) -> str:
    """What came of the parts, in words."""
    if not decisions:
        return "the space that is left is one part, the robot is in it"
    taken = [f"region {d.region}" for d in decisions if d.accepted]
    waiting = len(decisions) - len(taken)
    said = f"extracted {', '.join(taken)}" if taken else "nothing extracted"
    return f"{said}; {waiting} part{'s' * (waiting != 1)} not ready" if waiting else said


def _nearest_free(grid: OccupancyGrid, cell: IntArray) -> IntArray | None:
    """The free cell nearest to a cell."""
    free = np.argwhere(grid.free)
    if len(free) == 0:
        return None
    return np.asarray(free[((free - cell) ** 2).sum(axis=1).argmin()])


def _remaining(state: ExtractionState, grid: OccupancyGrid, robot: IntArray | None) -> BoolArray:
    """Free space that no closed region holds; only the part around the robot when that is given."""
    left = grid.free & (painted(state.closed, grid.geometry) == 0)
    if robot is None:
        return np.asarray(left)
    pieces, _ = ndimage.label(left)
    here = pieces[tuple(robot)]
    return np.asarray((pieces == here) & (here > 0))


def _fitness(
    mask: BoolArray, grid: OccupancyGrid, distance: FloatArray, config: AutonomousConfig
) -> tuple[float, str]:
    """Hidden pairs of a part and why it is not extracted ("" when it is)."""
    hidden = hidden_pairs(mask, ~grid.free)
    if mask.sum() * grid.geometry.cell_area < config.division.least_area:
        return hidden, "too small"
    if float(distance[mask].min()) < config.least_distance:
        return hidden, "the robot is still near"
    if hidden > config.division.most_hidden:
        return hidden, "not convex"
    rim = ndimage.binary_dilation(mask) & ~mask
    if float(grid.unknown[rim].mean()) > config.most_frontier:
        return hidden, "its rim is not explored yet"
    return hidden, ""
