"""Floor plans: borders, walls, doors."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.simulation.floor_plan import (
    Box,
    Opening,
    Room,
    cut_out,
    inner_borders,
    outer_borders,
)
from core.simulation.home import make_doors

LEFT = Room("left", "room", (Box(0, 0, 3, 4),))
RIGHT = Room("right", "room", (Box(3, 1, 6, 3),))
sides = st.floats(-5, 5, allow_nan=False).map(lambda v: round(v, 2))


def box_of(a: float, b: float, c: float, d: float) -> Box:
    return Box(min(a, b), min(c, d), max(a, b) + 0.1, max(c, d) + 0.1)


boxes = st.builds(box_of, sides, sides, sides, sides)


def test_two_rooms_share_the_stretch_where_they_touch() -> None:
    (border,) = inner_borders([LEFT, RIGHT])
    assert (border.vertical, border.at, border.start, border.stop) == (True, 3, 1, 3)
    assert border.rooms == ("left", "right")


def test_outer_borders_of_an_l_shaped_room_are_its_perimeter() -> None:
    room = Room("l", "room", (Box(0, 0, 4, 2), Box(0, 2, 1, 5)))
    assert sum(b.length for b in outer_borders([room])) == pytest.approx(2 * 4 + 2 * 5)


def test_outer_borders_leave_out_what_two_rooms_share() -> None:
    total = sum(b.length for b in outer_borders([LEFT, RIGHT]))
    assert total == pytest.approx(14 + 10 - 2 * 2)


@given(boxes, boxes)
def test_cutting_out_takes_away_just_the_overlap(box: Box, hole: Box) -> None:
    overlap_x = max(0.0, min(box.x1, hole.x1) - max(box.x0, hole.x0))
    overlap_y = max(0.0, min(box.y1, hole.y1) - max(box.y0, hole.y0))
    parts = cut_out(box, hole)
    assert sum(part.area for part in parts) == pytest.approx(box.area - overlap_x * overlap_y)
    assert not any(part.overlaps(hole) for part in parts)


def test_a_door_is_as_wide_as_asked_and_lies_in_the_shared_wall() -> None:
    (door,) = make_doors([LEFT, RIGHT], [Opening(("right", "left"), 0.9, 0.5)])
    assert door.width == pytest.approx(0.9)
    assert door.passed_along_x
    assert door.gap.centre == pytest.approx((3, 2))


def test_a_door_wider_than_the_shared_wall_is_refused() -> None:
    with pytest.raises(InputError, match="share no wall"):
        make_doors([LEFT, RIGHT], [Opening(("left", "right"), 1.8)])
