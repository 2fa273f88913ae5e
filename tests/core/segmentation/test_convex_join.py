import numpy as np

from core.segmentation.convex_join import convex_groups


def halves(grid, col):
    left = grid.free.copy()
    left[:, col:] = False
    return left, grid.free & ~left


def test_two_halves_of_a_room_are_one_and_the_larger_comes_first(square_map):
    parts = halves(square_map, 20)
    assert convex_groups(parts, ~square_map.free, 0.2, 400) == [[1, 0]]


def test_two_rooms_stay_two(two_rooms):
    parts = halves(two_rooms, round(4.6 / 0.05))
    assert convex_groups(parts, ~two_rooms.free, 0.2, 400) == [[0], [1]]


def test_parts_that_touch_along_too_little_stay_apart(square_map):
    parts = halves(square_map, 20)
    assert convex_groups(parts, ~square_map.free, 0.2, 400, least_border=71) == [[0], [1]]


def test_nothing_gives_no_groups():
    assert convex_groups([], np.zeros((3, 3), bool), 0.2, 400) == []
