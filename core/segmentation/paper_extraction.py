"""One step of autonomous extraction as in the paper (3.2.2)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.segmentation.convexity import convexity
from core.segmentation.decision import Decision, measure_cut
from core.segmentation.extraction_state import ExtractionState, painted
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.inheritance import opened_inside, reopened, taken_in, with_region
from core.segmentation.moment import Moment
from core.segmentation.paper_config import PaperConfig
from core.segmentation.paper_cut import (
    by_distance,
    frontier_share,
    least_grids,
    tentative_cut,
)
from core.segmentation.reliable_region import reliable_region


def extract_as_in_paper(
    state: ExtractionState, moment: Moment, config: PaperConfig | None = None
) -> ExtractionState:
    """One step: the reliable cells are cut in two; if eq. (9) holds, the farther half is extracted.

    Args:
        state: what is known so far.
        moment: its grid is the local map.
        config: parameters and open points.
    """
    config, grid = config or PaperConfig(), moment.grid
    robot = grid.geometry.cell_of(moment.pose[:2])
    if not grid.geometry.contains(robot) or not grid.free[tuple(robot)]:
        return recorded(state, moment, (), [], config, "the robot is not on free grids")
    state, said = _back(state, moment, robot, config)
    cells = _cells_around(state, moment, robot, config)
    large = cells.sum() >= 2 * least_grids(grid, config)
    found = tentative_cut(cells, grid, config) if large else None
    if found is None:
        said += "the reliable cells around the robot are too few to be cut"
        if large and convexity((cells,), grid, config.convexity) <= config.convexity.threshold:
            state = _joined(state, cells, moment, robot, config)
        return recorded(state, moment, (cells,), [], config, said)
    near, far = by_distance(found.cut, robot)
    waits = _unexplored(far, moment, config) if found.accepted else ""
    measures = measure_cut(far, cells, found.one, grid, config.convexity)
    accepted, hidden = found.accepted and not waits, hidden_pairs(far, ~grid.free)
    decision = Decision(2, measures, hidden, accepted, waits or found.reason)
    if accepted:
        state, region = with_region(state, far, grid.geometry)
        decision = replace(decision, region=region.number, came_from=region.parents)
        state = _joined(state, near, moment, robot, config)
    elif found.one <= config.convexity.threshold:
        state = _joined(state, cells, moment, robot, config)
    return recorded(state, moment, (near, far), [decision], config, said + decision.reason)


def _back(
    state: ExtractionState, moment: Moment, robot: IntArray, config: PaperConfig
) -> tuple[ExtractionState, str]:
    """The state with the region that the robot is back in open again, and that in words."""
    if config.reopening == "for_good":
        return reopened(state, moment.grid.geometry, robot)
    return opened_inside(state, moment.grid.geometry, robot, least_grids(moment.grid, config))


def _cells_around(
    state: ExtractionState, moment: Moment, robot: IntArray, config: PaperConfig
) -> BoolArray:
    """The reliable cells (rows, cols) around the robot that no closed region holds."""
    taken = painted(state.closed, moment.grid.geometry) > 0
    reliable = reliable_region(moment.grid, moment.confidence, robot, config.reliable) & ~taken
    pieces, _ = ndimage.label(reliable)
    return np.asarray((pieces == pieces[tuple(robot)]) & reliable)


def _joined(
    state: ExtractionState, cells: BoolArray, moment: Moment, robot: IntArray, config: PaperConfig
) -> ExtractionState:
    """The state with the open region that the robot is in grown to the cells around it."""
    if config.reopening == "for_good":
        return state
    return taken_in(state, cells, moment.grid.geometry, robot)


def _unexplored(far: BoolArray, moment: Moment, config: PaperConfig) -> str:
    """Why the farther cluster waits ("" when it need not)."""
    share = frontier_share(far, moment.grid)
    if config.most_frontier is None or share <= config.most_frontier:
        return ""
    return f"the farther cluster is not explored yet: {share:.0%} of its rim is unknown"


def recorded(
    state: ExtractionState,
    moment: Moment,
    parts: tuple[BoolArray, ...],
    decisions: list[Decision],
    config: PaperConfig,
    said: str,
) -> ExtractionState:
    """The state with the step in its history; the parts are its clusters 1, 2, ..."""
    clusters = np.zeros(moment.grid.geometry.shape, np.int64)
    for i, part in enumerate(parts):
        clusters[part] = i + 1
    conditions = config.convexity
    thresholds = {
        "c1": conditions.threshold,
        "c2_per_c1": conditions.factor,
        "c2_per_c1_narrow": conditions.narrow_factor if conditions.narrow is not None else None,
    }
    return state.recorded(moment, clusters, decisions, thresholds, said)
