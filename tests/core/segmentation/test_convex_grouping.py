import numpy as np
import pytest
from scipy import ndimage

from core.segmentation.connected import renumber
from core.segmentation.convex_grouping import GroupingConfig, grouped
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.small_cells import small_cells


def groups_of(grid, seed=0, **changed):
    cells = small_cells(grid.free, grid.occupied, grid)
    rooms, rng = np.where(grid.free, 1, 0), np.random.default_rng(seed)
    return grouped(cells, rooms, grid.occupied, 0.05, GroupingConfig(**changed), rng)


def blocks(free, size):
    """The floor in square cells of so many grids."""
    row, col = np.indices(free.shape) // size
    return renumber(np.where(free, 1 + row * free.shape[1] + col, 0))


def test_a_room_in_many_cells_is_one_region(square_map):
    found = grouped(
        blocks(square_map.free, 20),
        np.where(square_map.free, 1, 0),
        square_map.occupied,
        0.05,
        GroupingConfig(),
        np.random.default_rng(0),
    )
    np.testing.assert_array_equal(found, square_map.free)


def test_two_rooms_are_parted_at_the_door(two_rooms):
    found = groups_of(two_rooms)
    assert found.max() == 2
    assert len(np.unique(found[two_rooms.free][np.argwhere(two_rooms.free)[:, 1] < 88])) == 1


@pytest.mark.parametrize("seed", range(3))
def test_regions_are_few_connected_and_convex(corridor_with_three_rooms, l_shape, seed):
    for grid, count in ((corridor_with_three_rooms, 4), (l_shape, 2)):
        found = groups_of(grid, seed)
        assert found.max() == count
        for value in range(1, count + 1):
            assert ndimage.label(found == value)[1] == 1
            assert hidden_pairs(found == value, grid.occupied, 2000) <= 0.2 + 0.02


def test_no_more_is_cut_off_than_must_be():
    """A hall of 6 m x 4 m with an arm of 6 m x 1.5 m, of which the outer half is too much."""
    free = np.zeros((130, 220), bool)
    free[5:125, 5:85] = True
    free[5:35, 85:205] = True
    col = np.indices(free.shape)[1]
    cells = np.where(free, 1 + (col >= 85) + (col >= 145), 0)
    found = grouped(
        cells, np.where(free, 1, 0), ~free, 0.05, GroupingConfig(), np.random.default_rng(0)
    )
    np.testing.assert_array_equal(found == found[60, 60], free & (col < 145))
    assert found.max() == 2


def test_suggested_rooms_part_what_sees_each_other(square_map):
    cells = blocks(square_map.free, 20)
    west = np.isin(cells, np.unique(cells[:, :40]))
    rooms = np.where(square_map.free, np.where(west, 1, 2), 0)
    found = grouped(
        cells, rooms, square_map.occupied, 0.05, GroupingConfig(), np.random.default_rng(0)
    )
    np.testing.assert_array_equal(found == found[20, 20], west & square_map.free)


def test_no_cells_make_no_regions(square_map):
    nothing = np.zeros(square_map.state.shape, np.int64)
    rng = np.random.default_rng(0)
    assert grouped(nothing, nothing, nothing > 0, 0.05, GroupingConfig(), rng).max() == 0
