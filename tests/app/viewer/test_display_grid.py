"""What is drawn of a noisy grid."""

from __future__ import annotations

import numpy as np
import pytest

from app.viewer.display_grid import tidy
from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import GridGeometry

SHAPE = (80, 80)


def room(occupied: np.ndarray) -> OccupancyGrid:
    """4 m x 4 m of free floor inside a wall one grid thick, with more that is occupied."""
    wall = np.zeros(SHAPE, bool)
    wall[4, 4:76] = wall[75, 4:76] = wall[4:76, 4] = wall[4:76, 75] = True
    free = np.zeros(SHAPE, bool)
    free[5:75, 5:75] = True
    return OccupancyGrid.of(
        GridGeometry(0.05, (0.0, 0.0, 0.0), SHAPE), free & ~occupied, wall | occupied
    )


def nothing() -> np.ndarray:
    return np.zeros(SHAPE, bool)


def test_a_wall_one_grid_thick_is_drawn_without_gaps():
    display = tidy(room(nothing()))
    assert (display.walls[4, 6:74] > display.level).all()
    assert not (display.walls[20:60, 20:60] > display.level).any()


def test_a_single_stray_echo_is_not_drawn_but_is_floor():
    speck = nothing()
    speck[40, 40] = True
    display = tidy(room(speck))
    assert not display.solid[38:43, 38:43].any()
    assert display.floor[40, 40]


def test_a_small_island_is_furniture_and_low():
    chair = nothing()
    chair[30:38, 30:38] = True
    display = tidy(room(chair))
    assert display.furniture[34, 34] > display.level
    assert not (display.walls[28:40, 28:40] > display.level).any()


def test_the_outline_of_a_sofa_is_filled_even_with_a_gap():
    sofa = nothing()
    sofa[30:46, 30:60] = True
    sofa[32:44, 32:58] = False
    sofa[44:46, 40:44] = False
    grid = room(sofa)
    inside = grid.state.copy()
    inside[32:44, 32:58] = 0
    display = tidy(OccupancyGrid(grid.geometry, inside))
    assert (display.furniture[34:42, 34:56] > display.level).all()


def test_a_wall_across_the_room_is_not_furniture():
    wall = nothing()
    wall[40:42, 5:75] = True
    display = tidy(room(wall))
    assert display.walls[40, 40] > display.level
    assert not (display.furniture > display.level).any()


def test_an_unknown_pinhole_in_the_floor_is_filled():
    grid = room(nothing())
    state = grid.state.copy()
    state[40:42, 40:42] = 0
    assert tidy(OccupancyGrid(grid.geometry, state)).floor[40:42, 40:42].all()


def test_a_stray_beam_outside_is_not_drawn():
    grid = room(nothing())
    state = grid.state.copy()
    state[78, 10:13] = 1
    assert not tidy(OccupancyGrid(grid.geometry, state)).floor[78].any()


@pytest.mark.parametrize("value", [0, 1, 2])
def test_a_grid_of_one_kind_is_drawn_without_complaint(value):
    grid = OccupancyGrid(
        GridGeometry(0.05, (0.0, 0.0, 0.0), (6, 7)), np.full((6, 7), value, np.uint8)
    )
    assert tidy(grid).floor.shape == (6, 7)
