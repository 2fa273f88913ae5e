"""One goal after another: the ways there, backing off from what is run into, giving up."""

from __future__ import annotations

from collections.abc import Iterator

from core.geometry import FloatArray
from core.simulation.drive import DriveConfig
from core.simulation.path_follower import PathFollower
from core.simulation.robot import SimulatedRobot
from core.simulation.route_planner import RoutePlanner


class Course:
    """Drives a robot to goals (2,) in the home's frame."""

    def __init__(
        self, goals: Iterator[FloatArray], planner: RoutePlanner, config: DriveConfig
    ) -> None:
        self._goals = goals
        self._planner = planner
        self._config = config
        self._follower: PathFollower | None = None
        self._bumps = 0
        self._backing = 0

    def command(self, robot: SimulatedRobot) -> tuple[float, float] | None:
        """Speed (m/s) and turn rate (rad/s) to go on with; None when there is no goal left."""
        if robot.blocked:
            self._bumps += 1
            self._backing = self._config.back_off
            if self._bumps > self._config.bumps:
                self._follower = None
        if self._backing:
            self._backing -= 1
            return -self._config.cruise.speed / 2, 0.0
        while self._follower is not None or self._begin(robot):
            assert self._follower is not None
            command = self._follower.command(robot.pose)
            if command is not None:
                return command
            self._follower = None
        return None

    def _begin(self, robot: SimulatedRobot) -> bool:
        """Takes the next goal, if there is one."""
        goal = next(self._goals, None)
        if goal is None:
            return False
        route = self._planner.route(robot.pose[:2], goal)
        self._follower = PathFollower(route, self._config.cruise)
        self._bumps = 0
        return True
