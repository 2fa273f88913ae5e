from dataclasses import replace

import pytest

from core.segmentation.convexity import PRINTED, convexity, is_to_be_cut


def test_a_square_room_is_convex(square_map):
    grid = square_map
    assert convexity((grid.free,), grid) == 0.0


def test_an_l_has_the_notch_in_its_hull(l_shape):
    # Arms 30 and 10 grids... the notch is a triangle: 80 x 80 / 2 of 5 cm grids beside the floor.
    grid = l_shape
    floor = grid.free.sum()
    assert convexity((grid.free,), grid) == pytest.approx(80 * 80 / 2 / floor, rel=0.05)


def test_as_printed_two_rooms_with_a_thin_wall_are_not_cut_but_would_be_by_what_is_not_free(
    two_rooms,
):
    grid = two_rooms
    wall = 14 * 5 * 5 - 3 * 5 * 5
    one = convexity((grid.free,), grid, PRINTED)
    assert one == pytest.approx(wall / grid.free.sum(), rel=0.02)
    assert not is_to_be_cut(one, 0.0, 0.0, PRINTED)


def test_the_condition_needs_both_halves_of_eq_9():
    printed = replace(PRINTED, counted="not_free")
    assert is_to_be_cut(0.3, 0.1, 0.0, printed)
    assert not is_to_be_cut(0.1, 0.0, 0.0, printed)
    assert not is_to_be_cut(0.3, 0.16, 0.0, printed)


def test_a_cut_at_a_narrow_place_needs_to_gain_less_than_one_across_open_floor():
    door, floor = 0.3, 1.0
    assert is_to_be_cut(0.4, 0.3, door)
    assert not is_to_be_cut(0.4, 0.3, floor)
    assert is_to_be_cut(0.4, 0.1, floor)
    assert not is_to_be_cut(0.4, 0.39, door)
