from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import MapError
from core.mapping import GridGeometry
from core.mapping.bayes import bayes_map
from core.mapping.cemal import cemal_map
from core.mapping.map_result import MapResult
from core.sensing import RobotLog, Trajectory

HALF_SIDE = 1.5


def distance_to_wall(geometry: GridGeometry, mask: np.ndarray) -> np.ndarray:
    """Signed metres of the cells' centres inside (positive) the square room's walls."""
    centres = geometry.world_of(np.argwhere(mask))
    return HALF_SIDE - np.abs(centres).max(axis=1)


def map_of(log: RobotLog) -> MapResult:
    return cemal_map(log, Trajectory.from_odometry(log))


def test_the_walls_of_a_square_room_are_where_they_are(square_room: RobotLog) -> None:
    grid = map_of(square_room).grid
    inside = distance_to_wall(grid.geometry, grid.occupied)
    assert (np.abs(inside) <= 0.10).mean() > 0.95
    assert distance_to_wall(grid.geometry, grid.free).min() > -0.10
    assert grid.free.sum() * grid.geometry.cell_area == pytest.approx(9.0, rel=0.07)


def test_a_false_echo_in_the_middle_of_the_room_is_dropped(square_room: RobotLog) -> None:
    ranges = square_room.ranges.copy()
    ranges[10, 2] = 1.3  # two metres lie free there
    result = map_of(replace(square_room, ranges=ranges))
    assert not result.kept[10, 2]
    assert distance_to_wall(result.grid.geometry, result.grid.occupied).max() < 0.2


def test_a_reading_that_went_through_the_wall_is_dropped(square_room: RobotLog) -> None:
    ranges = square_room.ranges.copy()
    ranges[25, 2] = 3.9  # the far wall is 2.2 m away
    result = map_of(replace(square_room, ranges=ranges))
    assert not result.kept[25, 2]
    assert distance_to_wall(result.grid.geometry, result.grid.free).min() > -0.10


def test_the_footprint_of_the_robot_is_free(square_room: RobotLog) -> None:
    grid = map_of(square_room).grid
    cells = grid.geometry.cell_of(square_room.odometry[:, :2] + [0.15, 0.0])
    assert grid.free[cells[:, 0], cells[:, 1]].all()


def test_latched_readings_and_missing_echoes_are_not_used(square_room: RobotLog) -> None:
    ranges, fresh = square_room.ranges.copy(), square_room.fresh.copy()
    ranges[:, 1] = np.nan
    fresh[:, 3] = False
    result = map_of(replace(square_room, ranges=ranges, fresh=fresh))
    assert not result.kept[:, [1, 3]].any()
    assert result.kept[:, 0].any()


def test_confidence_is_positive_exactly_where_the_map_is_occupied(square_room: RobotLog) -> None:
    result = map_of(square_room)
    np.testing.assert_array_equal(result.confidence > 0, result.grid.occupied)


def test_the_same_drive_gives_the_same_map(square_room: RobotLog) -> None:
    first, second = map_of(square_room), map_of(square_room)
    np.testing.assert_array_equal(first.grid.state, second.grid.state)
    np.testing.assert_array_equal(first.confidence, second.confidence)


def test_a_moved_trajectory_moves_the_map(square_room: RobotLog) -> None:
    moved = square_room.odometry + np.array([10.0, -4.0, 0.0])
    there = cemal_map(square_room, Trajectory.at(square_room.t, moved)).grid
    here = map_of(square_room).grid
    np.testing.assert_allclose(
        np.array(there.geometry.origin) - here.geometry.origin, [10, -4, 0], atol=1e-9
    )
    assert (there.state != here.state).mean() < 0.005  # rounding at cell borders


def test_a_drive_across_the_country_is_refused(square_room: RobotLog) -> None:
    odometry = square_room.odometry.copy()
    odometry[-1, 0] = 9000.0
    with pytest.raises(MapError, match="check the units"):
        map_of(replace(square_room, odometry=odometry))


def test_the_bayes_map_frees_the_inside_of_a_room_and_nothing_outside(
    square_room: RobotLog,
) -> None:
    grid = bayes_map(square_room, Trajectory.from_odometry(square_room)).grid
    centres = grid.geometry.world_of(np.argwhere(np.ones(grid.geometry.shape, bool)))
    deep = (np.abs(centres).max(axis=1) < 0.9).reshape(grid.geometry.shape)
    assert grid.free[deep].mean() > 0.99
    assert distance_to_wall(grid.geometry, grid.free).min() > -0.10
    assert (
        np.abs(distance_to_wall(grid.geometry, grid.occupied)) <= 0.15
    ).mean() > 0.8  # arcs reach past corners
