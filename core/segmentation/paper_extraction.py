"""One step of autonomous extraction as in the paper (3.2.2), with its open points as options."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.segmentation.convex_split import two_way_cut
from core.segmentation.convexity import ConvexityConfig, convexity, is_to_be_cut
from core.segmentation.decision import Decision, measure_cut
from core.segmentation.extraction_state import (
    ExtractionState,
    painted,
)
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.inheritance import reopened, with_region
from core.segmentation.moment import Moment
from core.segmentation.reliable_region import ReliableConfig, reliable_region
from core.wording import counted


@dataclass(frozen=True)
class PaperConfig:
    """Parameters of the paper's extraction.

    Attributes:
        step: metres of travel between two steps; the paper names none.
        window: metres of travel that the local map holds: a sliding window measured better than
            all data so far in two of three homes; None takes all.
        reliable: of the reliable region (eq. 6).
        convexity: of the condition (eq. 7-9).
        least_area: square metres of a cluster; the paper tells of none. With 1 m2 furniture makes
            2.5 regions a room, with 3 m2 2.1, as pure (six simulated homes).
        max_cell: largest quadtree cell in grids.
    """

    step: float = 2.5
    window: float | None = 12.0
    reliable: ReliableConfig = field(default_factory=ReliableConfig)
    convexity: ConvexityConfig = field(default_factory=ConvexityConfig)
    least_area: float = 3.0
    max_cell: int = 32


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
        return _recorded(state, moment, (), [], config, "the robot is not on free grids")
    state, said = reopened(state, grid.geometry, robot)
    taken = painted(state.closed, grid.geometry) > 0
    reliable = reliable_region(grid, moment.confidence, robot, config.reliable) & ~taken
    pieces, _ = ndimage.label(reliable)
    cells = (pieces == pieces[tuple(robot)]) & reliable
    least = config.least_area / grid.geometry.cell_area
    cut = two_way_cut(cells, least, config.max_cell) if cells.sum() >= 2 * least else None
    if cut is None:
        said += "the reliable cells around the robot are too few to be cut"
        return _recorded(state, moment, (cells,), [], config, said)
    near, far = _by_distance((cut.first, cut.second), robot)
    one = convexity((cells,), grid, config.convexity)  # eq. (7)
    measures = measure_cut(far, cells, one, grid, config.convexity)  # eq. (8)
    accepted = is_to_be_cut(one, measures.c2, config.convexity)  # eq. (9)
    why = _reason(one, measures.c2, config.convexity)
    decision = Decision(2, measures, hidden_pairs(far, ~grid.free), accepted, why)
    if accepted:
        state, region = with_region(state, far, grid.geometry)
        decision = replace(decision, region=region.number, came_from=region.parents)
    return _recorded(state, moment, (near, far), [decision], config, said + why)


def finish_as_in_paper(
    state: ExtractionState, moment: Moment, config: PaperConfig | None = None
) -> ExtractionState:
    """The end of a drive: every piece of floor that is left becomes a region."""
    config, grid = config or PaperConfig(), moment.grid
    left = grid.free & (painted(state.closed, grid.geometry) == 0)
    one = convexity((left,), grid, config.convexity) if left.any() else 0.0
    labels, count = ndimage.label(left)
    pieces, decisions = [labels == value for value in range(1, count + 1)], []
    for i, piece in enumerate(pieces):
        if piece.sum() * grid.geometry.cell_area < config.least_area:
            continue
        measures = measure_cut(piece, left, one, grid, config.convexity)
        hidden = hidden_pairs(piece, ~grid.free)
        state, region = with_region(state, piece, grid.geometry, is_open=True)
        decisions.append(
            Decision(
                i + 1, measures, hidden, True, "end of the drive", region.number, region.parents
            )
        )
    said = f"end of the drive: {counted(len(decisions), 'piece')} left"
    return _recorded(state, moment, tuple(pieces), decisions, config, said)


def _by_distance(
    halves: tuple[BoolArray, BoolArray], robot: IntArray
) -> tuple[BoolArray, BoolArray]:
    """The half whose centre is nearer to the robot, then the other one."""
    away = [np.hypot(*(np.argwhere(half).mean(axis=0) - robot)) for half in halves]
    return halves if away[0] <= away[1] else (halves[1], halves[0])


def _reason(one: float, two: float, config: ConvexityConfig) -> str:
    """Eq. (9) in words."""
    if one <= config.threshold:
        return f"convex enough: C1 = {one:.2f} is not above c_t = {config.threshold:g}"
    limit = config.factor * one
    if two >= limit:
        return f"the cut gains too little: C2 = {two:.2f} is not below {limit:.2f}"
    return f"C1 = {one:.2f} is above c_t = {config.threshold:g}, C2 = {two:.2f} below {limit:.2f}"


def _recorded(
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
    thresholds = {"c1": config.convexity.threshold, "c2_per_c1": config.convexity.factor}
    return state.recorded(moment, clusters, decisions, thresholds, said)
