"""The simulated robot, step by step."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.sensing import RING_PRESETS
from core.simulation.floor_plan import Box, Room
from core.simulation.furniture import piece
from core.simulation.home import Home
from core.simulation.odometry import ODOMETRY
from core.simulation.robot import SimulatedRobot

ROOM = Home("room", (Room("room", "room", (Box(0, 0, 6, 4),)),), ())


def robot(home: Home = ROOM, pose: tuple[float, float, float] = (3.0, 2.0, 0.0)) -> SimulatedRobot:
    return SimulatedRobot(
        home, RING_PRESETS["paper-12"], np.array(pose), errors=ODOMETRY["none"], seed=1
    )


def test_it_drives_at_the_speed_it_is_given() -> None:
    one = robot()
    for _ in range(4):
        scan = one.step(0.2, 0.0, 0.25)
    assert one.pose == pytest.approx((3.2, 2.0, 0.0))
    assert scan.odometry == pytest.approx(one.pose)
    assert scan.t == pytest.approx(1.0)
    assert len(scan.ranges) == 12


def test_it_stops_at_a_wall_but_still_turns() -> None:
    one = robot()
    for _ in range(60):
        one.step(0.4, 0.0, 0.25)
    assert one.blocked
    assert one.pose[0] == pytest.approx(5.9 - one.ring.robot_radius, abs=0.02)
    one.step(0.4, 0.5, 0.25)
    assert one.pose[2] == pytest.approx(0.125)


def test_being_carried_away_does_not_show_in_the_odometry() -> None:
    one = robot()
    before = one.odometry.pose.copy()
    one.place(np.array([1.0, 1.0, 2.0]))
    scan = one.sense()
    assert scan.odometry == pytest.approx(before)
    assert one.pose == pytest.approx((1.0, 1.0, 2.0))


def test_a_sofa_that_is_carried_out_is_heard_no_more() -> None:
    home = Home("room", ROOM.rooms, (), (piece("chest", Box(4.0, 1.0, 4.5, 3.0)),))
    one = robot(home)
    with_chest = np.nanmedian([one.sense().ranges[0] for _ in range(20)])
    one.enter(home.without("chest"))
    without = np.nanmedian([one.sense().ranges[0] for _ in range(20)])
    assert with_chest == pytest.approx(1.0 - 0.2, abs=0.04)
    assert without == pytest.approx(2.9 - 0.2, abs=0.08)


def test_a_shut_door_cannot_be_passed(paper: Home) -> None:
    door = next(d for d in paper.doors if "bedroom" in d.rooms)
    x, y = door.gap.centre
    below = (x, y - 0.6, math.pi / 2)
    through, against = robot(paper, below), robot(paper.with_shut(door.name), below)
    for _ in range(20):
        through.step(0.2, 0.0, 0.25)
        against.step(0.2, 0.0, 0.25)
    assert through.pose[1] > y + 0.3
    assert against.pose[1] < y - 0.2
    assert against.blocked


def test_equal_seeds_give_equal_scans() -> None:
    one, two = robot(), robot()
    for _ in range(5):
        a, b = one.step(0.1, 0.2, 0.25), two.step(0.1, 0.2, 0.25)
        assert np.array_equal(a.ranges, b.ranges, equal_nan=True)
