"""A simulated robot does what it is told, and its home stays as somebody has left it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from app.robots.order import COMMAND, HOMES, ODOMETRY, RobotOrder
from app.robots.pilot import NEAR_ENOUGH, Pilot, Task
from app.robots.world import described
from core.errors import InputError
from core.log_readers.native import parse_scan
from core.simulation.homes import NAMED
from core.simulation.odometry import ODOMETRY as KNOWN_ODOMETRY

Tell = Callable[..., None]
STANDS = RobotOrder(mode="drive")


def told(pilot: Pilot, **command: object) -> None:
    pilot.obey(COMMAND.validate_python(command))


def drive_until(pilot: Pilot, task: Task, most_steps: int = 2000) -> None:
    for _ in range(most_steps):
        if pilot.task is task:
            return
        pilot.step()
    pytest.fail(f"still {pilot.task} after {most_steps} steps")


def test_the_choices_are_those_of_the_simulation() -> None:
    assert set(HOMES) == set(NAMED)
    assert set(ODOMETRY) == set(KNOWN_ODOMETRY)


def test_a_scan_is_a_line_of_a_live_robot_and_holds_no_truth() -> None:
    pilot = Pilot(STANDS)
    record = pilot.step()
    assert parse_scan(record, pilot.robot.ring).t == 0.25
    assert "truth" not in record
    assert "truth" in Pilot(RobotOrder(mode="drive", evaluation=True)).step()


def test_equal_orders_give_equal_scans() -> None:
    first, second = Pilot(RobotOrder(seed=4)), Pilot(RobotOrder(seed=4))
    assert [first.step() for _ in range(20)] == [second.step() for _ in range(20)]


def test_a_drive_command_that_is_not_renewed_ends_after_a_second() -> None:
    pilot = Pilot(STANDS)
    start = pilot.robot.pose.copy()
    told(pilot, type="drive", speed=0.0, turn_rate=1.0)
    for _ in range(12):
        pilot.step()
    assert pilot.task is Task.STAND
    assert pilot.robot.pose[2] - start[2] == pytest.approx(1.0)
    assert pilot.standing_s == 2.0


def test_a_goal_is_reached_through_doors() -> None:
    pilot = Pilot(STANDS)
    x, y = pilot.home.room("kitchen").boxes[0].centre
    told(pilot, type="goal", x=x, y=y)
    drive_until(pilot, Task.STAND)
    assert np.hypot(*(pilot.robot.pose[:2] - (x, y))) < NEAR_ENOUGH + 0.2


def test_a_goal_outside_the_home_is_refused_in_words() -> None:
    with pytest.raises(InputError, match="finds no way to"):
        told(Pilot(STANDS), type="goal", x=-20.0, y=0.0)


def test_a_carried_robot_is_elsewhere_and_its_odometry_does_not_notice() -> None:
    pilot = Pilot(STANDS)
    before, believed = pilot.robot.pose.copy(), pilot.robot.odometry.pose.copy()
    told(pilot, type="place")
    assert np.hypot(*(pilot.robot.pose - before)[:2]) >= 3.0
    np.testing.assert_array_equal(pilot.robot.odometry.pose, believed)
    x, y = pilot.home.room("kitchen").boxes[0].centre
    told(pilot, type="place", x=x, y=y, heading=0.5)
    assert np.hypot(*(pilot.robot.pose[:2] - (x, y))) < NEAR_ENOUGH
    with pytest.raises(InputError, match="cannot stand at"):
        told(pilot, type="place", x=50.0, y=0.0)


def test_behind_a_shut_door_there_is_no_way_until_it_is_open_again() -> None:
    pilot = Pilot(STANDS)
    study = pilot.home.room("study").boxes[0].centre
    bedroom = pilot.home.room("bedroom").boxes[0].centre
    told(pilot, type="place", x=bedroom[0], y=bedroom[1])
    told(pilot, type="door", name="door 2", shut=True)
    assert {"door 2"} == {d["name"] for d in described(pilot.home)["doors"] if d["shut"]}
    with pytest.raises(InputError, match="no way"):
        told(pilot, type="goal", x=study[0], y=study[1])
    told(pilot, type="door", name="door 2", shut=False)
    told(pilot, type="goal", x=study[0], y=study[1])
    assert pilot.task is Task.GOAL


def test_no_door_is_shut_on_the_robot_and_openings_have_none() -> None:
    pilot = Pilot(STANDS)
    x, y = pilot.home.door("door 1").gap.centre
    told(pilot, type="place", x=x, y=y)
    with pytest.raises(InputError, match="the robot stands in door 1"):
        told(pilot, type="door", name="door 1", shut=True)
    with pytest.raises(InputError, match="an opening without a door"):
        told(pilot, type="door", name="door 5", shut=True)
    with pytest.raises(InputError, match="has no door 'door 9'"):
        told(pilot, type="door", name="door 9", shut=True)


def test_furniture_is_pushed_to_where_there_is_room_and_then_seen_there() -> None:
    pilot = Pilot(STANDS)
    x, y = pilot.robot.pose[:2]
    told(pilot, type="furniture", name="chair", x=x + 0.8, y=y)
    chair = pilot.home.piece("chair").footprint
    assert np.hypot(chair.centre[0] - x - 0.8, chair.centre[1] - y) < 0.9
    assert not any(chair.overlaps(wall) for wall in pilot.home.walls)
    with pytest.raises(InputError, match="no room for the chair"):
        told(pilot, type="furniture", name="chair", x=90.0, y=y)


def test_a_mapping_tour_ends_when_everything_was_come_near_to() -> None:
    pilot = Pilot(RobotOrder(home="hall", seed=1))
    drive_until(pilot, Task.STAND, most_steps=8000)
    assert pilot.toured
    assert pilot.distance_m > 20
