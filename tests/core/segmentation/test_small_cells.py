import numpy as np
from scipy import ndimage

from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.small_cells import small_cells


def test_cells_cover_the_floor_and_each_is_in_one_piece(corridor_with_three_rooms):
    grid = corridor_with_three_rooms
    cells = small_cells(grid.free, grid.occupied, grid)
    np.testing.assert_array_equal(cells > 0, grid.free)
    for value in range(1, cells.max() + 1):
        assert ndimage.label(cells == value)[1] == 1


def test_no_cell_reaches_round_a_wall(two_rooms):
    cells = small_cells(two_rooms.free, two_rooms.occupied, two_rooms)
    shares = [hidden_pairs(cells == v, two_rooms.occupied) for v in range(1, cells.max() + 1)]
    assert max(shares) <= 0.15


def test_no_floor_has_no_cells(square_map):
    nothing = np.zeros(square_map.state.shape, bool)
    assert small_cells(nothing, square_map.occupied, square_map).max() == 0
