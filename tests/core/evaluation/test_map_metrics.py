"""Map metrics on a home small enough to count by hand."""

from __future__ import annotations

import numpy as np
import pytest

from core.evaluation import GroundTruth, map_metrics
from core.geometry import BoolArray
from core.mapping.occupancy_grid import GridGeometry, OccupancyGrid

CELL = 0.05
ROWS, COLS = 44, 84
DOOR = (2.05, 0.6, 2.15, 1.4)
"""Gap in the wall between the two rooms, metres."""


def two_rooms() -> GroundTruth:
    """Two rooms of 2 m x 2 m with a wall of two cells between them and a door of 0.8 m in it."""
    occupied = np.zeros((ROWS, COLS), bool)
    occupied[:2] = occupied[-2:] = True
    occupied[:, :2] = occupied[:, -2:] = True
    occupied[:, 41:43] = True
    occupied[12:28, 41:43] = False
    rooms = np.ones((ROWS, COLS), np.int64)
    rooms[:, 42:] = 2
    free = ~occupied
    geometry = GridGeometry(CELL, (0.0, 0.0, 0.0), (ROWS, COLS))
    return GroundTruth(
        geometry, occupied, free, free, np.where(free, rooms, 0), ("a", "b"), np.array([DOOR])
    )


def surface_of(truth: GroundTruth) -> BoolArray:
    grown = np.pad(truth.free, 1)
    near = sum(
        grown[1 + i : 1 + i + ROWS, 1 + j : 1 + j + COLS].astype(int)
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
    )
    return truth.occupied & (near > 0)


def perfect(truth: GroundTruth) -> OccupancyGrid:
    return OccupancyGrid.of(truth.geometry, truth.free, surface_of(truth))


def test_a_perfect_map_scores_one_everywhere() -> None:
    truth = two_rooms()
    m = map_metrics(perfect(truth), truth)
    assert (m.precision_1, m.recall_1, m.free_iou, m.surface_2) == (1.0, 1.0, 1.0, 1.0)
    assert (m.doors, m.doors_blocked, m.rooms_seen, m.leaks, m.leak_m2) == (1, 0, 2, 0, 0.0)
    assert m.free_m2 == pytest.approx(truth.free.sum() * CELL**2)


def test_phantoms_in_the_middle_of_a_room_cost_precision_only() -> None:
    truth = two_rooms()
    grid = perfect(truth)
    free, occupied = grid.free, grid.occupied
    good = int(occupied.sum())
    occupied[20, 10:15] = True
    m = map_metrics(OccupancyGrid.of(truth.geometry, free, occupied), truth)
    assert m.precision_1 == pytest.approx(good / (good + 5))
    assert m.recall_1 == 1.0


def test_a_wall_that_is_two_cells_off_counts_for_two_cells_only() -> None:
    truth = two_rooms()
    occupied = np.zeros((ROWS, COLS), bool)
    occupied[3, 4:40] = True  # the lower wall's surface is row 1
    m = map_metrics(OccupancyGrid.of(truth.geometry, truth.free & ~occupied, occupied), truth)
    assert (m.precision_1, m.precision_2) == (0.0, 1.0)
    assert m.recall_1 == 0.0
    assert m.recall_2 > 0.1


def test_a_door_walled_up_is_blocked() -> None:
    truth = two_rooms()
    grid = perfect(truth)
    occupied = grid.occupied
    occupied[12:28, 41] = True
    m = map_metrics(OccupancyGrid.of(truth.geometry, grid.free, occupied), truth)
    assert (m.doors, m.doors_blocked) == (1, 1)


def test_a_door_that_was_not_explored_is_not_judged() -> None:
    truth = two_rooms()
    explored = truth.free.copy()
    explored[:, 30:] = False
    part = GroundTruth(
        truth.geometry, truth.occupied, truth.free, explored, truth.rooms, truth.names, truth.doors
    )
    assert map_metrics(perfect(truth), part).doors == 0


def test_a_hole_in_a_wall_is_a_leak() -> None:
    truth = two_rooms()
    grid = perfect(truth)
    occupied, free = grid.occupied, grid.free
    occupied[34:42, 40:44] = False
    free[34:42, 40:44] = True
    m = map_metrics(OccupancyGrid.of(truth.geometry, free, occupied), truth)
    assert m.leaks == 1


def test_free_floor_claimed_outside_the_home_costs_overlap_and_leaks() -> None:
    truth = two_rooms()
    geometry = GridGeometry(CELL, (0.0, 0.0, 0.0), (ROWS, COLS + 20))
    free = np.pad(truth.free, ((0, 0), (0, 20)))
    free[10:20, COLS + 4 : COLS + 14] = True
    occupied = np.zeros(geometry.shape, bool)
    m = map_metrics(OccupancyGrid.of(geometry, free, occupied), truth)
    real = truth.free.sum()
    assert m.free_iou == pytest.approx(real / (real + 100))
    assert m.leak_m2 == pytest.approx(100 * CELL**2)


def test_an_empty_map_scores_nothing() -> None:
    truth = two_rooms()
    nothing = np.zeros((ROWS, COLS), bool)
    m = map_metrics(OccupancyGrid.of(truth.geometry, nothing, nothing), truth)
    assert (m.precision_1, m.recall_2, m.free_iou) == (0.0, 0.0, 0.0)
    assert m.doors_blocked == 1


def test_a_map_on_a_turned_grid_scores_like_the_same_map_upright() -> None:
    truth = two_rooms()
    upright = perfect(truth)
    turned = OccupancyGrid(
        GridGeometry(CELL, (COLS * CELL, 0.0, np.pi / 2), (COLS, ROWS)),
        np.ascontiguousarray(upright.state.T[::-1]),
    )
    assert map_metrics(turned, truth) == map_metrics(upright, truth)
