from dataclasses import replace

import numpy as np

from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.extraction_state import ExtractionState, painted
from core.segmentation.inheritance import opened_inside, taken_in, with_region
from core.segmentation.moment import Moment
from core.segmentation.paper_config import PaperConfig
from core.segmentation.paper_cut import tentative_cut
from core.segmentation.paper_end import finish_as_in_paper

CELL = 0.05


def floor_map(*boxes):
    """Free boxes `(row0, row1, col0, col1)` in a map of 100 x 200 grids that is occupied elsewhere."""
    state = np.full((100, 200), 2, np.uint8)
    for row0, row1, col0, col1 in boxes:
        state[row0:row1, col0:col1] = 1
    return OccupancyGrid(GridGeometry(CELL, (0.0, 0.0, 0.0), state.shape), state)


def mask_of(grid, row0, row1, col0, col1):
    mask = np.zeros(grid.state.shape, bool)
    mask[row0:row1, col0:col1] = True
    return mask & grid.free


def ended(state, grid, config=None):
    moment = Moment(0.0, 0.0, np.zeros(3), grid, np.zeros(grid.state.shape))
    return finish_as_in_paper(state, moment, config)


def room_with_a_bed():
    """4 m x 4 m around a bed of 1.6 m x 2 m at the wall: not convex, and no narrow place in it."""
    grid = floor_map((10, 90, 10, 90))
    grid.state[50:90, 34:66] = 2
    return grid


def test_a_furnished_room_is_not_cut_across_its_floor_unless_eq_9_has_one_factor_for_all_borders():
    grid, config = room_with_a_bed(), PaperConfig()
    found = tentative_cut(grid.free, grid, config)
    assert found.one > config.convexity.threshold
    assert not found.accepted
    one_factor = replace(config.convexity, narrow=None, factor=0.7)
    assert tentative_cut(grid.free, grid, replace(config, convexity=one_factor)).accepted


def test_a_furnished_room_and_a_corridor_are_cut_at_the_door():
    grid = room_with_a_bed()
    grid.state[16:32, 90:94] = 1
    grid.state[10:40, 94:190] = 1
    found = tentative_cut(grid.free, grid, PaperConfig())
    assert found.accepted
    room = mask_of(grid, 10, 90, 10, 92)
    assert min(np.mean(half != room) for half in (found.cut.first, found.cut.second)) < 0.02


def test_a_region_is_open_only_while_the_robot_is_in_it():
    grid = floor_map((10, 50, 10, 150))
    state, west = with_region(ExtractionState(), mask_of(grid, 10, 50, 10, 80), grid.geometry)
    inside, said = opened_inside(state, grid.geometry, np.array([20, 20]), 100)
    assert not inside.closed
    assert f"back in region {west.number}" in said
    outside, said = opened_inside(inside, grid.geometry, np.array([20, 120]), 100)
    assert [region.number for region in outside.closed] == [west.number]
    assert said == ""


def test_the_region_that_the_robot_is_in_takes_in_the_cells_around_it():
    grid = floor_map((10, 50, 10, 150))
    state, _ = with_region(ExtractionState(), mask_of(grid, 10, 50, 10, 80), grid.geometry)
    robot = np.array([20, 20])
    assert len(taken_in(state, grid.free, grid.geometry, robot).regions[0].cells) == 40 * 70
    state, _ = opened_inside(state, grid.geometry, robot, 100)
    assert len(taken_in(state, grid.free, grid.geometry, robot).regions[0].cells) == 40 * 140


def test_what_is_left_at_the_end_is_cut_and_small_pieces_join_the_longest_border():
    grid = floor_map((10, 90, 10, 90), (40, 56, 90, 94), (10, 90, 94, 174))
    grid.state[10:40, 60:90], grid.state[60:90, 94:130] = 2, 2
    left = grid.free & ~mask_of(grid, 10, 30, 10, 60)
    cut = ended(ExtractionState(), grid)
    assert len(cut.regions) == 2
    pieces = replace(PaperConfig(), at_end="pieces")
    assert len(ended(ExtractionState(), grid, pieces).regions) == 1
    state, most = with_region(ExtractionState(), left, grid.geometry)
    (only,) = ended(state, grid).regions
    assert only.number == most.number
    assert np.array_equal(painted((only,), grid.geometry) > 0, grid.free)
