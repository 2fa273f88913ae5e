import numpy as np
import pytest

from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.mutual_visibility import hidden_between, sight_blockers


def halves(grid, col):
    return np.where(grid.free, np.where(np.arange(grid.state.shape[1]) < col, 1, 2), 0)


def test_everything_in_a_square_room_sees_everything(square_map):
    shares = hidden_between(halves(square_map, 40), square_map.occupied, 0.05)
    np.testing.assert_array_equal(shares, np.zeros((2, 2)))


def test_two_rooms_hardly_see_each_other(two_rooms):
    shares = hidden_between(halves(two_rooms, round(4.6 / 0.05)), two_rooms.occupied, 0.05)
    assert shares[0, 1] == shares[1, 0]
    assert shares[0, 1] > 0.6
    assert max(shares[0, 0], shares[1, 1]) < 0.001


def test_a_wall_of_one_grid_hides_and_a_union_s_share_is_the_mean_over_its_pairs():
    floor = np.ones((41, 41), bool)
    floor[20] = False
    cells = np.where(floor, np.where(np.arange(41)[:, None] < 20, 1, 2), 0)
    shares = hidden_between(cells, ~floor, 0.05)
    np.testing.assert_array_equal(shares, [[0, 1], [1, 0]])


def test_a_cell_that_no_look_out_lies_in_is_looked_from_too():
    cells = np.ones((20, 20), int)
    cells[7, 7] = 2
    assert np.isfinite(hidden_between(cells, np.zeros((20, 20), bool), 0.05)).all()


@pytest.mark.parametrize(("cells", "hides"), [(3, False), (30, True)])
def test_specks_hide_nothing(cells, hides):
    state = np.ones((60, 60), np.uint8)
    state[30, 10 : 10 + cells] = 2
    grid = OccupancyGrid(GridGeometry(0.05, (0.0, 0.0, 0.0), state.shape), state)
    assert sight_blockers(grid).any() == hides


def test_a_wall_in_pieces_is_no_speck():
    state = np.ones((60, 60), np.uint8)
    for col in range(10, 50, 6):
        state[30, col : col + 3] = 2
    grid = OccupancyGrid(GridGeometry(0.05, (0.0, 0.0, 0.0), state.shape), state)
    np.testing.assert_array_equal(sight_blockers(grid), state == 2)
