"""Drives a simulated robot as it was last told, one scan at a time. No clock, no network."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from enum import StrEnum
from typing import Any

import numpy as np

from app.robots.course import Course
from app.robots.order import Command, Door, Drive, GoTo, Move, Place, RobotOrder, Stop, Tour
from app.robots.world import with_door, with_furniture_at
from core.errors import InputError
from core.geometry import FloatArray
from core.log_readers.native_line import scan_record
from core.sensing.ring import RING_PRESETS
from core.simulation import DriveConfig, Home, SimulatedRobot, build_home
from core.simulation.odometry import odometry_errors
from core.simulation.route_planner import RoutePlanner
from core.simulation.tour import mapping_goals, random_pose, roaming_goals

HOLDS_S = 1.0
"""A drive command that is not renewed ends after this many simulated seconds."""
NEAR_ENOUGH = 0.75
"""A robot that is carried to a place is put down at most this far from it (m)."""
APART = 0.1
"""The way so far is remembered every so many metres: what a tour needs to know."""
LOOKED_AT = 64
"""Places that are looked at for one far away."""


class Task(StrEnum):
    """What a robot is doing."""

    TOUR = "tour"
    GOAL = "goal"
    DRIVE = "drive"
    STAND = "stand"


class Pilot:
    """A robot in a home. The same order and commands give the same scans.

    Attributes:
        robot: the simulated robot; its true pose stays in here unless the order is for evaluation.
        task: what it is doing.
        distance_m: driven so far.
        toured: whether it has come near everything that it can reach.
        standing_s: simulated seconds since it last moved.
    """

    def __init__(self, order: RobotOrder) -> None:
        """A robot somewhere in its home.

        Raises:
            InputError: the robot is too large for the home.
        """
        home, ring = build_home(order.home), RING_PRESETS[order.ring]
        self._config = DriveConfig()
        self._localizes = order.model_id is not None
        self._tells_truth = order.evaluation
        key = [order.seed, zlib.crc32(f"{home.name}/live".encode())]
        self._rng = np.random.default_rng([*key, 1])
        self._planner = RoutePlanner(home, ring.robot_radius)
        start = random_pose(self._planner, self._rng)
        self.robot = SimulatedRobot(
            home,
            ring,
            start,
            np.zeros(3) if self._localizes else start,
            errors=odometry_errors(order.odometry),
            seed=[*key, 2],
        )
        self.task = Task.STAND
        self.distance_m = 0.0
        self.toured = False
        self.standing_s = 0.0
        self._course: Course | None = None
        self._goal: FloatArray | None = None
        self._wheels = (0.0, 0.0)
        self._holds_until = 0.0
        self._driven = [start[:2].copy()]
        if order.mode == "tour":
            self._tour()

    @property
    def home(self) -> Home:
        """The home as it is now."""
        return self.robot.home

    @property
    def period_s(self) -> float:
        """Simulated seconds between two scans."""
        return self._config.scan_period

    def localizes(self) -> None:
        """From now on the robot is looked for in a model: a tour goes from room to room."""
        self._localizes = True
        self.toured = False

    def obey(self, command: Command) -> None:
        """Does what it is told.

        Raises:
            InputError: it cannot; nothing has changed.
        """
        match command:
            case Drive():
                self.task, self._course = Task.DRIVE, None
                self._wheels = (command.speed, command.turn_rate)
                self._holds_until = self.robot.t + HOLDS_S
            case GoTo():
                self._go(np.array([command.x, command.y]))
            case Tour():
                self._tour()
            case Stop():
                self._stand()
            case Place():
                self._place(command)
            case Door():
                where = self.robot.pose[:2], self.robot.ring.robot_radius
                self._enter(with_door(self.home, command.name, command.shut, *where))
            case Move():
                where = self.robot.pose[:2], self.robot.ring.robot_radius
                place = (command.x, command.y)
                self._enter(with_furniture_at(self.home, command.name, place, *where))
            case _:
                raise InputError(f"{command.type} is nothing that a robot does by itself")

    def step(self) -> dict[str, Any]:
        """Drives on until the next scan is due; the scan as a line of a native log."""
        before, period = self.robot.pose, self._config.scan_period
        wheels = self._next_wheels()
        scan = self.robot.step(*wheels, period)
        moved = float(np.hypot(*(self.robot.pose - before)[:2]))
        self.distance_m += moved
        self.standing_s = 0.0 if wheels != (0.0, 0.0) else self.standing_s + period
        if np.hypot(*(self.robot.pose[:2] - self._driven[-1])) >= APART:
            self._driven.append(self.robot.pose[:2].copy())
        return scan_record(scan, self.robot.pose if self._tells_truth else None)

    def _next_wheels(self) -> tuple[float, float]:
        if self.task is Task.DRIVE:
            if self.robot.t < self._holds_until:
                return self._wheels
            self._stand()
        if self._course is None:
            return 0.0, 0.0
        command = self._course.command(self.robot)
        if command is None:
            self.toured = self.toured or self.task is Task.TOUR
            self._stand()
            return 0.0, 0.0
        return command

    def _stand(self) -> None:
        self.task, self._course, self._goal = Task.STAND, None, None

    def _go(self, goal: FloatArray) -> None:
        self._goal = self._reachable(goal)
        self.task = Task.GOAL
        self._course = Course(iter([self._goal]), self._planner, self._config)
        self.standing_s = 0.0

    def _tour(self) -> None:
        self.task, self._goal, self.standing_s = Task.TOUR, None, 0.0
        self._course = Course(self._tour_goals(), self._planner, self._config)

    def _tour_goals(self) -> Iterator[FloatArray]:
        if self._localizes:
            return roaming_goals(self._planner, self.robot.pose[:2], self._rng)
        return mapping_goals(self.home, self._planner, lambda: np.array(self._driven))

    def _place(self, command: Place) -> None:
        if command.x is None or command.y is None:
            pose = self._far_away()
        else:
            pose = self._standable(np.array([command.x, command.y]), command.heading)
        planner = RoutePlanner(self.home, self.robot.ring.robot_radius, pose[:2])
        self.robot.place(pose)
        self._driven.append(pose[:2].copy())
        self._replan(planner, keeps_goal=False)

    def _far_away(self) -> FloatArray:
        poses = [random_pose(self._planner, self._rng) for _ in range(LOOKED_AT)]
        apart = np.array([np.hypot(*(pose - self.robot.pose)[:2]) for pose in poses])
        far = np.flatnonzero(apart >= self._config.kidnap_apart)
        return poses[int(far[0]) if len(far) else int(apart.argmax())]

    def _standable(self, place: FloatArray, heading: float | None) -> FloatArray:
        planner = RoutePlanner(self.home, self.robot.ring.robot_radius, place)
        spot = planner.nearest_passable(place)
        if np.hypot(*(spot - place)) > NEAR_ENOUGH:
            raise InputError(f"the robot cannot stand at ({place[0]:.2f}, {place[1]:.2f})")
        return np.array([*spot, self.robot.pose[2] if heading is None else heading])

    def _enter(self, home: Home) -> None:
        """The home has changed around the robot."""
        planner = RoutePlanner(home, self.robot.ring.robot_radius, self.robot.pose[:2])
        self.robot.enter(home)
        self._replan(planner, keeps_goal=True)

    def _replan(self, planner: RoutePlanner, keeps_goal: bool) -> None:
        self._planner = planner
        self.standing_s = 0.0
        if self.task is Task.TOUR:
            self._tour()
        elif self.task is Task.GOAL and keeps_goal and self._goal is not None:
            self._course = Course(iter([self._goal]), planner, self._config)
        elif self.task is Task.GOAL:
            self._stand()

    def _reachable(self, goal: FloatArray) -> FloatArray:
        spot = self._planner.nearest_passable(goal)
        if np.hypot(*(spot - goal)) > NEAR_ENOUGH:
            raise InputError(f"the robot finds no way to ({goal[0]:.2f}, {goal[1]:.2f})")
        return spot
