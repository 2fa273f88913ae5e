import numpy as np
import pytest

from core.segmentation.boundary_walls import flush_walls, jambs, walls_in_line

RESOLUTION = 0.05
FRAME = (100.0, 100.0, 1.0, 0.0)
"""A border that runs along the rows through the middle of the map."""


@pytest.fixture
def corridor():
    """A corridor along the columns, 21 grids wide."""
    floor = np.zeros((201, 201), bool)
    floor[90:111] = True
    return floor


@pytest.fixture
def doorway():
    """Two halls 201 grids high and a wall of one grid between them, with a gap of 21."""
    floor = np.ones((201, 201), bool)
    floor[:90, 100] = floor[111:, 100] = False
    return floor


def test_the_walls_of_a_corridor_go_on_from_a_border_across_it(corridor):
    assert flush_walls(FRAME, 21.0, corridor, RESOLUTION) == pytest.approx((1.0, 1.0, 1.0))


def test_no_wall_goes_on_at_right_angles_from_a_doorway(doorway):
    assert flush_walls(FRAME, 21.0, doorway, RESOLUTION) == (0.0, 0.0, 0.0)


def test_a_corridor_that_opens_into_a_hall_has_flush_walls_on_one_side(corridor):
    corridor[:, 101:] = True
    low, high, line = flush_walls(FRAME, 21.0, corridor, RESOLUTION)
    assert (low, line) == (0.0, 0.0)
    assert high == pytest.approx(1.0)


def test_a_doorway_has_jambs_and_a_wall_in_line_with_it(doorway):
    assert jambs(FRAME, 21.0, doorway, RESOLUTION) == pytest.approx((1.0, 1.0))
    low, high, line = walls_in_line(FRAME, 21.0, ~doorway, RESOLUTION)
    assert low == pytest.approx(1.0)
    assert high == pytest.approx(1.0)
    # 90 grids of wall on each side of the gap; rounding may lose one at each end.
    assert line == pytest.approx(180 * RESOLUTION, abs=3 * RESOLUTION)
