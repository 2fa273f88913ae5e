from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from core.errors import InputError, MapError
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.offline import segment_offline


def two_rooms() -> np.ndarray:
    """Two rooms of 40 x 40 grids with a wall between them and a door of 10 grids."""
    free = np.zeros((44, 86), bool)
    free[2:42, 2:42] = free[2:42, 44:84] = True
    free[17:27, 42:44] = True
    return free


def test_two_rooms_joined_by_a_door_are_cut_at_the_door() -> None:
    regions = segment_offline(two_rooms(), 2)
    left, right = regions[20, 10], regions[20, 70]
    assert left != right
    assert (regions[2:42, 2:42] == left).all()
    assert (regions[2:42, 44:84] == right).all()


def test_every_region_is_connected_and_all_floor_is_divided() -> None:
    free = two_rooms()
    regions = segment_offline(free, 7)
    np.testing.assert_array_equal(regions > 0, free)
    assert set(np.unique(regions)) == set(range(8))
    for value in range(1, 8):
        assert ndimage.label(regions == value)[1] == 1


@pytest.mark.parametrize("k", [0, -3, 10_000])
def test_an_impossible_number_of_regions_is_refused(k: int) -> None:
    with pytest.raises(InputError, match="choose a number from 1 to"):
        segment_offline(two_rooms(), k)


def test_a_map_without_free_space_is_refused() -> None:
    with pytest.raises(MapError, match="no free space"):
        segment_offline(np.zeros((4, 4), bool), 1)


def test_hidden_pairs_see_a_wall_one_grid_thick() -> None:
    free = np.ones((20, 41), bool)
    free[:19, 20] = False  # a passage of one grid is left
    assert hidden_pairs(free, ~free) > 0.3
    assert hidden_pairs(np.ones((20, 41), bool), np.zeros((20, 41), bool)) == 0.0
