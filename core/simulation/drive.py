"""Drives: a home, a tour and a seed in, a log with ground truth out."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, get_args

import numpy as np

from core.errors import UsageError
from core.geometry import FloatArray
from core.progress import Progress, no_progress
from core.sensing.ring import RING_PRESETS, SonarRing
from core.sensing.robot_log import RobotLog
from core.simulation.changes import changed_home
from core.simulation.home import Home
from core.simulation.homes import build_home
from core.simulation.odometry import odometry_errors
from core.simulation.path_follower import Cruise, PathFollower
from core.simulation.robot import SimulatedRobot
from core.simulation.route_planner import RoutePlanner
from core.simulation.sonar_model import SonarModel
from core.simulation.tour import mapping_goals, random_pose, roaming_goals

Tour = Literal["mapping", "localization", "spin"]
TOURS: tuple[str, ...] = get_args(Tour)
KIDNAP_CHOICES = 64
"""Places that are looked at for one far enough away."""
POSE_DECIMALS = 4
"""Poses are logged to 0.1 mm and 0.1 mrad."""


@dataclass(frozen=True)
class DriveConfig:
    """How drives are made.

    Attributes:
        scan_period: seconds between scans (paper, Sect. 5: 4 Hz).
        mapping_length: a mapping tour goes on until it is this long (m).
        localization_length: shortest and longest localization drive (m).
        spin_turns: turns on the spot of a "spin".
        bumps: a goal is given up when the robot runs into something more often on its way there.
        back_off: scans that it then drives backwards.
        kidnap_apart: a kidnapped robot is carried at least this far (m).
        cruise: how the robot is driven.
    """

    scan_period: float = 0.25
    mapping_length: float = 92.0
    localization_length: tuple[float, float] = (25.0, 40.0)
    spin_turns: int = 5
    bumps: int = 3
    back_off: int = 4
    kidnap_apart: float = 3.0
    cruise: Cruise = field(default_factory=Cruise)


@dataclass(frozen=True)
class Incidents:
    """What goes wrong in the middle of a drive.

    Attributes:
        kidnap: the robot is carried elsewhere half-way.
        jump: the odometry jumps ahead by this half-way (m).
    """

    kidnap: bool = False
    jump: float = 0.0


def simulate(
    home: str | Home,
    *,
    seed: int = 0,
    tour: Tour = "mapping",
    odometry: str = "calibrated",
    ring: SonarRing | None = None,
    changed: bool = False,
    kidnap: bool = False,
    jump: float = 0.0,
    sonar: SonarModel | None = None,
    config: DriveConfig | None = None,
    progress: Progress = no_progress,
) -> RobotLog:
    """Drives a simulated robot and returns its log with the true poses.

    Equal arguments give equal logs.

    Args:
        home: a name that `build_home` knows, or a home.
        seed: the drive and its noise.
        tour: "mapping" visits every room, its odometry starts at the true pose; "localization"
            roams 25-40 m from anywhere, its odometry starts at (0, 0, 0); "spin" turns on the spot.
        odometry: "none", "calibrated" or "bad".
        ring: the sonars, by default the paper's twelve.
        changed: the sofa and a chair are gone or moved and a door is shut.
        kidnap: half-way the robot is carried elsewhere.
        jump: half-way the odometry jumps ahead by so many metres.
        sonar: physics other than the default.
        config: other lengths and speeds.

    Raises:
        UsageError: an unknown home, tour or odometry, or a negative seed.
        InputError: the robot is too large for the home.
    """
    config = config or DriveConfig()
    if seed < 0:
        raise UsageError(f"the seed {seed} is negative; take a number from 0")
    if tour not in TOURS:
        raise UsageError(f"tour {tour!r} is not one of {', '.join(TOURS)}")
    errors, ring = odometry_errors(odometry), ring or RING_PRESETS["paper-12"]
    home = build_home(home) if isinstance(home, str) else home
    home = changed_home(home, seed) if changed else home
    key = [seed, zlib.crc32(f"{home.name}/{tour}".encode())]
    goals_rng, pose_rng = np.random.default_rng([*key, 1]).spawn(2)
    planner = RoutePlanner(home, ring.robot_radius)
    start = random_pose(planner, pose_rng)
    origin = start if tour == "mapping" else np.zeros(3)
    robot = SimulatedRobot(home, ring, start, origin, errors=errors, seed=[*key, 2], sonar=sonar)
    drive = _Drive(robot, planner, config, Incidents(kidnap, jump), pose_rng, progress)
    roaming = roaming_goals(planner, start, goals_rng)
    if tour == "mapping":
        drive.visit(mapping_goals(home, planner, lambda: drive.driven), config.mapping_length)
        drive.roam(roaming, config.mapping_length)
    elif tour == "localization":
        drive.roam(roaming, float(goals_rng.uniform(*config.localization_length)))
    else:
        drive.spin()
    return drive.log(f"{home.name} home, {tour} {seed}")


class _Drive:
    """A drive under way: steps the robot and keeps what it sensed and where it was."""

    def __init__(
        self,
        robot: SimulatedRobot,
        planner: RoutePlanner,
        config: DriveConfig,
        incidents: Incidents,
        rng: np.random.Generator,
        progress: Progress,
    ) -> None:
        self._robot = robot
        self._planner = planner
        self._config = config
        self._incidents = incidents
        self._rng = rng
        self._progress = progress
        self._distance = 0.0
        self._happened = not incidents.kidnap and incidents.jump == 0.0
        self._scans = [robot.sense()]
        self._poses = [robot.pose.copy()]

    @property
    def driven(self) -> FloatArray:
        """True positions (N, 2) so far."""
        return np.array(self._poses)[:, :2]

    def visit(self, goals: Iterator[FloatArray], length: float) -> None:
        """Visits goals, all of them."""
        for goal in goals:
            self._go_to(goal, length)

    def roam(self, goals: Iterator[FloatArray], length: float) -> None:
        """Visits goals until `length` metres are driven."""
        while self._distance < length:
            self._go_to(next(goals), length, stop_at_length=True)

    def spin(self) -> None:
        """Turns on the spot."""
        rate = self._config.cruise.turn_rate
        steps = int(self._config.spin_turns * 2 * np.pi / (rate * self._config.scan_period))
        for _ in range(steps):
            self._step(0.0, rate)

    def log(self, name: str) -> RobotLog:
        """The drive so far."""
        return RobotLog(
            name,
            self._robot.ring,
            np.array([scan.t for scan in self._scans]),
            np.round([scan.odometry for scan in self._scans], POSE_DECIMALS),
            np.array([scan.ranges for scan in self._scans]),
            np.array([scan.fresh for scan in self._scans]),
            np.round(self._poses, POSE_DECIMALS),
        )

    def _go_to(self, goal: FloatArray, length: float, stop_at_length: bool = False) -> None:
        """Drives to a goal, gives up when stuck, or leaves off when something happens."""
        route = self._planner.route(self._robot.pose[:2], goal)
        follower = PathFollower(route, self._config.cruise)
        bumps = 0
        while bumps <= self._config.bumps:
            command = follower.command(self._robot.pose)
            if command is None or (stop_at_length and self._distance >= length):
                break
            self._step(*command)
            if self._robot.blocked:
                bumps += 1
                self._back_off()
            if not self._happened and self._distance >= length / 2:
                self._happen()
                break
        self._progress(min(self._distance / length, 1.0), "driving")

    def _back_off(self) -> None:
        """Away from what the robot ran into, the way it came."""
        for _ in range(self._config.back_off):
            self._step(-self._config.cruise.speed / 2, 0.0)

    def _step(self, speed: float, turn_rate: float) -> None:
        before = self._robot.pose
        self._scans.append(self._robot.step(speed, turn_rate, self._config.scan_period))
        self._poses.append(self._robot.pose.copy())
        self._distance += float(np.hypot(*(self._robot.pose - before)[:2]))

    def _happen(self) -> None:
        """The incidents of the middle of the drive."""
        self._happened = True
        self._robot.odometry.jump(np.array([self._incidents.jump, 0.0, 0.0]))
        if self._incidents.kidnap:
            poses = [random_pose(self._planner, self._rng) for _ in range(KIDNAP_CHOICES)]
            apart = [float(np.hypot(*(pose - self._robot.pose)[:2])) for pose in poses]
            far = [i for i, d in enumerate(apart) if d >= self._config.kidnap_apart]
            self._robot.place(poses[far[0] if far else int(np.argmax(apart))])
