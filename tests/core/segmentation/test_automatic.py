import numpy as np
import pytest

from core.errors import MapError
from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.automatic import segment_automatically, segment_rooms
from core.segmentation.hidden_pairs import hidden_pairs


def test_two_rooms_joined_by_a_door_are_cut_at_the_door(two_rooms):
    grid = two_rooms
    found = segment_automatically(grid)
    assert found.rooms.max() == 2
    column = np.flatnonzero(np.diff(found.rooms[grid.geometry.shape[0] // 2].astype(int)) != 0)
    between = [c for c in column if 40 < c < 140]
    # The wall with the door covers the grids 90..94.
    assert between
    assert all(84 <= c <= 99 for c in between)


def test_a_plain_square_stays_one_room_and_one_region(square_map):
    found = segment_automatically(square_map)
    assert found.rooms.max() == 1
    assert found.regions.max() == 1


def test_an_l_becomes_convex_regions(l_shape):
    grid = l_shape
    found = segment_automatically(grid)
    assert found.regions.max() >= 2
    for value in range(1, found.regions.max() + 1):
        assert hidden_pairs(found.regions == value, ~grid.free) <= 0.2


def test_a_corridor_and_its_three_rooms_are_four_rooms(corridor_with_three_rooms):
    assert segment_automatically(corridor_with_three_rooms).rooms.max() == 4


def test_every_region_lies_in_one_room(corridor_with_three_rooms):
    found = segment_automatically(corridor_with_three_rooms)
    for value in range(1, found.regions.max() + 1):
        assert len(np.unique(found.rooms[found.regions == value])) == 1


def test_the_same_map_gives_the_same_regions(two_rooms):
    first, second = (segment_automatically(two_rooms, seed=3) for _ in range(2))
    assert np.array_equal(first.regions, second.regions)


def test_a_map_without_free_space_is_refused():
    geometry = GridGeometry(0.05, (0.0, 0.0, 0.0), (20, 20))
    with pytest.raises(MapError, match="no free space"):
        segment_automatically(OccupancyGrid(geometry, np.zeros((20, 20), np.uint8)))


def test_rooms_can_be_had_without_their_regions(corridor_with_three_rooms):
    rooms = segment_rooms(corridor_with_three_rooms)
    assert np.array_equal(rooms, segment_automatically(corridor_with_three_rooms).rooms)


def test_a_wall_in_pieces_parts_regions_though_no_piece_is_larger_than_a_chair():
    """A thin wall across a square, mapped in pieces of .5 m with gaps of .15 m between them."""
    free = np.zeros((140, 140), bool)
    free[10:130, 10:130] = True
    occupied = np.zeros_like(free)
    for row in range(10, 130, 13):
        occupied[row : min(row + 10, 130), 69:71] = True
    free &= ~occupied
    grid = OccupancyGrid.of(GridGeometry(0.05, (0.0, 0.0, 0.0), free.shape), free, occupied)
    found = segment_automatically(grid)
    assert found.regions.max() > 1
    for value in range(1, found.regions.max() + 1):
        assert hidden_pairs(found.regions == value, occupied) <= 0.2
