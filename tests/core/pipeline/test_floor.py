"""The floor of a drive: what hangs together with where the robot has been, and is no hearsay."""

import numpy as np

from core.geometry import BoolArray, IntArray
from core.mapping import GridGeometry, OccupancyGrid
from core.mapping.map_result import MapResult
from core.pipeline.floor import floor_of_drive
from core.sensing import Trajectory

ROOM = (slice(5, 35), slice(5, 35))
BEYOND = (slice(10, 30), slice(45, 65))
"""Two places of 3 m x 3 m and 2 m x 2 m at 10 cm a cell, joined by a passage of .8 m."""


def seen(witnesses_beyond: int, room: int = 9) -> MapResult:
    """The two places, each called empty by so many readings."""
    witnesses = np.zeros((40, 70), np.int64)
    witnesses[ROOM] = room
    witnesses[16:24, 35:45] = witnesses_beyond
    witnesses[BEYOND] = witnesses_beyond
    return result_of(witnesses > 0, witnesses)


def result_of(free: BoolArray, witnesses: IntArray) -> MapResult:
    grid = OccupancyGrid.of(GridGeometry(0.1, (0.0, 0.0, 0.0), free.shape), free, ~free)
    return MapResult(grid, np.zeros(free.shape), np.ones((1, 1), bool), witnesses)


def standing_at(x: float, y: float) -> Trajectory:
    return Trajectory.at(np.zeros(1), np.array([[x, y, 0.0]]))


def test_a_room_that_two_readings_looked_into_is_floor() -> None:
    floor = floor_of_drive(seen(2), standing_at(2.0, 2.0))
    assert floor[ROOM].all()
    assert floor[BEYOND].all()


def test_a_fan_that_one_reading_alone_frees_is_no_floor() -> None:
    floor = floor_of_drive(seen(1), standing_at(2.0, 2.0))
    assert floor[ROOM].all()
    assert not floor[BEYOND].any()


def test_a_small_corner_that_one_reading_alone_frees_is_floor() -> None:
    result = seen(2)
    result.witnesses[5:14, 5:14] = 1  # .81 m2
    assert floor_of_drive(result, standing_at(2.0, 2.0))[ROOM].all()


def test_what_the_first_reading_frees_around_the_robot_is_floor() -> None:
    result = seen(2, room=1)
    result.witnesses[18:23, 18:23] = 0  # under the robot
    assert floor_of_drive(result, standing_at(2.0, 2.0))[ROOM].all()
