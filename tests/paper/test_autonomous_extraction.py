"""The claims of Section 3.2 on maps drawn by hand, where the right cut is known.

A drive is a line of poses; at each the robot knows what it has seen so far: the cells within the
reach of its sonars that no wall hides from one of the poses behind it.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numba
import numpy as np
import pytest

from core.geometry import BoolArray, FloatArray, travelled
from core.log_readers import read_log
from core.mapping import GridGeometry, OccupancyGrid
from core.pipeline.growing_model import METHODS, ExtractionMethod, MethodName, grown_along
from core.pipeline.mapper import MappingOptions
from core.segmentation.convexity import PRINTED
from core.segmentation.extraction_state import ExtractionState, painted
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.moment import Moment
from core.segmentation.paper_config import PaperConfig
from core.segmentation.paper_end import finish_as_in_paper
from core.segmentation.paper_extraction import extract_as_in_paper
from core.sensing import Trajectory

RESOLUTION, BLOCK = 0.05, 5
"""Metres a grid; a character of a drawing is 0.25 m x 0.25 m."""
REACH = 4.0
"""Metres that a sonar sees."""
STEP = 1.0
"""Metres between two moments of a drive."""
SAMPLES = Path(__file__).parents[2] / "sample_logs"
Points = list[tuple[float, float]]


def grid_of(drawing: list[str]) -> OccupancyGrid:
    """The map of a drawing (`#` wall, `.` floor); its last line is the lowest row."""
    characters = np.array([list(line) for line in drawing[::-1]])
    state = np.kron(np.where(characters == ".", 1, 2), np.ones((BLOCK, BLOCK), int))
    return OccupancyGrid(GridGeometry(RESOLUTION, (0.0, 0.0, 0.0), state.shape), state.astype("u1"))


def two_rooms() -> OccupancyGrid:
    """4 m x 3.5 m each, a door of 0.75 m in the wall between x = 4.25 m and 4.5 m."""
    line = "#" + "." * 16 + "#" + "." * 16 + "#"
    door = "#" + "." * 33 + "#"
    return grid_of(["#" * 35, *[door if i in (6, 7, 8) else line for i in range(14)], "#" * 35])


def l_shape() -> OccupancyGrid:
    """Two arms of 6 m x 2 m that share a corner."""
    lines = ["#" + "." * 8 + "#" * 17 for _ in range(16)] + ["#" + "." * 24 + "#" for _ in range(8)]
    return grid_of(["#" * 26, *lines, "#" * 26])


def t_shape() -> OccupancyGrid:
    """A bar of 8 m x 2 m on a stem of 2 m x 4.5 m."""
    lines = ["#" + "." * 32 + "#" for _ in range(8)]
    lines += ["#" * 13 + "." * 8 + "#" * 13 for _ in range(18)]
    return grid_of(["#" * 34, *lines, "#" * 34])


def corridor_with_three_rooms() -> OccupancyGrid:
    """Rooms of 3 m x 3 m, each with a door of 0.75 m to a corridor of 9.5 m x 1.5 m."""
    lines = [("#" + "." * 12) * 3 + "#" for _ in range(12)]
    lines += [("#" * 5 + "..." + "#" * 5) * 3 + "#"]
    lines += ["#" + "." * 38 + "#" for _ in range(6)]
    return grid_of(["#" * 40, *lines, "#" * 40])


def along(points: Points) -> FloatArray:
    """Poses (n, 3) every STEP metres along a line of points."""
    corners = np.column_stack((points, np.zeros(len(points))))
    driven = travelled(corners)
    at = np.arange(0.0, driven[-1], STEP)
    return np.column_stack([np.interp(at, driven, corners[:, axis]) for axis in range(3)])


@numba.njit(cache=True)
def visible(free: BoolArray, row: float, col: float, reach: float) -> BoolArray:
    """The cells that no wall hides from a cell; walls that are seen are among them."""
    seen = np.zeros(free.shape, np.bool_)
    for r in range(free.shape[0]):
        for c in range(free.shape[1]):
            away = np.hypot(r - row, c - col)
            steps = int(2 * away) + 1
            hidden = away > reach
            for k in range(1, steps):
                i = int(round(row + (r - row) * k / steps))
                j = int(round(col + (c - col) * k / steps))
                if not free[i, j] and (i != r or j != c):
                    hidden = True
                    break
            seen[r, c] = not hidden
    return seen


def moments(grid: OccupancyGrid, points: Points) -> Iterator[Moment]:
    """What the robot knows along a drive. Every sixth wall grid was seen with low confidence."""
    known = np.zeros(grid.state.shape, bool)
    poses = along(points)
    rows, cols = np.indices(grid.state.shape)
    confidence = np.where((rows + cols) % 6 == 0, 1.0, 2.0)
    for i, pose in enumerate(poses):
        row, col = grid.geometry.cell_of(pose[:2])
        known |= visible(grid.free, row, col, REACH / RESOLUTION)
        so_far = OccupancyGrid(grid.geometry, np.where(known, grid.state, 0).astype(np.uint8))
        yield Moment(float(i), i * STEP, pose, so_far, np.where(so_far.occupied, confidence, 0.0))


def driven(grid: OccupancyGrid, points: Points, method: MethodName) -> ExtractionState:
    """The state after a drive that may go on."""
    state, how = ExtractionState(), METHODS[method]
    for moment in moments(grid, points):
        state = how.extract(state, moment, how.config)
    return state


def ended(grid: OccupancyGrid, points: Points, method: MethodName) -> ExtractionState:
    """The state at the end of a drive."""
    *_, last = moments(grid, points)
    return METHODS[method].finish(driven(grid, points, method), last, METHODS[method].config)


def at(state: ExtractionState, grid: OccupancyGrid, x: float, y: float) -> int:
    """Number of the region at a point, 0 = none."""
    return int(painted(state.regions, grid.geometry)[tuple(grid.geometry.cell_of((x, y)))])


def accepted(state: ExtractionState) -> list[dict[str, Any]]:
    """The decisions that made a region."""
    return [dict(e) for e in state.history if e["event"] == "extract" and e["accepted"]]


WEST_TO_EAST: Points = [(2.0, 2.5), (2.25, 1.75), (3.5, 1.75), (5.0, 1.75), (7.5, 1.75)]
both = pytest.mark.parametrize("method", ["default", "paper"])


def test_two_rooms_joined_by_a_door_are_cut_at_the_door() -> None:
    grid = two_rooms()
    state = driven(grid, WEST_TO_EAST, "default")
    (west,) = state.regions
    assert abs(west.cells[:, 1].max() * RESOLUTION - 4.375) <= 0.3
    assert at(state, grid, 2.0, 2.0) == west.number
    assert at(state, grid, 7.5, 1.75) == 0
    (cut,) = accepted(state)[0]["cut"]
    assert all(abs(x - 4.375) <= 0.4 for x, _ in cut)


def test_eq_7_does_not_see_the_thin_wall_between_two_rooms_side_by_side() -> None:
    state = driven(two_rooms(), WEST_TO_EAST, "paper")
    whole = [entry for entry in state.history if entry["event"] == "extract"][-1]
    assert whole["c1"] <= 0.1
    assert not whole["accepted"]


ROUND_THE_CORNER: Points = [(1.25, 5.5), (1.25, 1.25), (5.75, 1.25)]


@both
def test_the_cluster_farther_from_the_robot_is_extracted(method: MethodName) -> None:
    grid = l_shape()
    state = driven(grid, ROUND_THE_CORNER, method)
    assert at(state, grid, 1.25, 5.5) > 0
    assert at(state, grid, 5.75, 1.25) == 0
    state = driven(grid, ROUND_THE_CORNER[::-1], method)
    assert at(state, grid, 5.75, 1.25) > 0
    assert at(state, grid, 1.25, 5.5) == 0


@both
def test_an_extracted_region_is_left_alone_until_the_robot_is_back(method: MethodName) -> None:
    grid = l_shape()
    before = driven(grid, ROUND_THE_CORNER, method)
    number = at(before, grid, 1.25, 5.5)
    stays = driven(grid, [*ROUND_THE_CORNER, (5.0, 1.75), (5.75, 1.5)], method)
    first, later = (
        next(region for region in state.regions if region.number == number).cells
        for state in (before, stays)
    )
    np.testing.assert_array_equal(first, later)
    back = driven(grid, [*ROUND_THE_CORNER, *ROUND_THE_CORNER[1::-1]], method)
    assert any(f"back in region {number}" in str(e.get("said")) for e in back.history)


@both
def test_a_convex_room_is_never_cut(method: MethodName) -> None:
    grid = grid_of(["#" * 18, *["#" + "." * 16 + "#" for _ in range(14)], "#" * 18])
    state = driven(grid, [(1.0, 1.0), (3.5, 1.0), (3.5, 3.0), (1.0, 3.0), (1.0, 1.0)], method)
    assert accepted(state) == []


@both
def test_the_arms_of_an_l_are_two_convex_regions(method: MethodName) -> None:
    grid = l_shape()
    state = ended(grid, [(1.25, 5.0), (1.25, 1.25), (5.5, 1.25)], method)
    up, right = at(state, grid, 1.25, 5.5), at(state, grid, 5.5, 1.25)
    assert 0 not in (up, right)
    assert up != right
    for region in state.regions:
        mask = painted((region,), grid.geometry) > 0
        assert hidden_pairs(mask, ~grid.free, 2000) <= 0.25


@both
def test_the_bar_and_the_stem_of_a_t_are_cut(method: MethodName) -> None:
    grid = t_shape()
    state = ended(grid, [(1.25, 5.75), (4.0, 5.75), (7.0, 5.75), (4.0, 5.75), (4.0, 1.0)], method)
    stem, ends = at(state, grid, 4.0, 1.0), {at(state, grid, x, 5.75) for x in (1.0, 7.0)}
    assert 0 not in {stem, *ends}
    assert stem not in ends


def three_room_drive() -> Points:
    """Into each room and back, then to the east end of the corridor."""
    points: Points = [(0.75, 1.0)]
    for x in (1.625, 4.875, 8.125):
        points += [(x, 1.0), (x, 3.5), (x, 1.0)]
    return [*points, (9.0, 1.0)]


def test_a_corridor_with_three_rooms_has_a_region_for_each() -> None:
    grid = corridor_with_three_rooms()
    state = ended(grid, three_room_drive(), "default")
    rooms = [at(state, grid, x, 3.5) for x in (1.75, 5.0, 8.25)]
    corridor = {at(state, grid, x, 0.75) for x in (0.75, 4.9, 9.0)}
    assert 0 not in {*rooms, *corridor}
    assert len(set(rooms)) == 3
    assert not corridor & set(rooms)


def test_in_the_paper_s_method_the_rooms_that_the_robot_has_left_are_regions() -> None:
    grid = corridor_with_three_rooms()
    state = driven(grid, three_room_drive(), "paper")
    left = [at(state, grid, x, 3.5) for x in (1.75, 5.0)]
    corridor = {at(state, grid, x, 0.75) for x in (0.75, 9.0)}
    assert 0 not in left
    assert left[0] != left[1]
    assert not corridor & set(left)


@both
def test_regions_keep_their_numbers_while_the_drive_goes_on(method: MethodName) -> None:
    grid, points = corridor_with_three_rooms(), three_room_drive()
    half = driven(grid, points[:8], method)
    whole = driven(grid, points, method)
    assert half.closed
    for region in half.closed:
        (later,) = [r for r in whole.regions if r.number == region.number]
        shared = {*map(tuple, region.cells)} & {*map(tuple, later.cells)}
        assert len(shared) >= 0.5 * len(region.cells)


def test_as_printed_eq_9_never_fires_in_a_home_but_does_with_all_that_is_not_free_counted() -> None:
    log = read_log(SAMPLES / "paper-mapping.jsonl.gz").log.without_truth().slice(0, 1200)
    poses = Trajectory.from_odometry(log)
    fired, largest = {}, {}
    for name, config in (("printed", PaperConfig(convexity=PRINTED)), ("ours", PaperConfig())):
        how = ExtractionMethod(config, extract_as_in_paper, finish_as_in_paper)
        state = grown_along(log, poses, MappingOptions(), how).state
        tried = [entry for entry in state.history if entry["event"] == "extract"]
        assert len(tried) >= 10
        fired[name] = sum(entry["accepted"] for entry in tried)
        largest[name] = max(entry["c1"] for entry in tried)
    assert fired["printed"] == 0
    assert largest["printed"] < PRINTED.threshold
    assert fired["ours"] >= 3
