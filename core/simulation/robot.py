"""A simulated robot: give it a speed, get a scan."""

from __future__ import annotations

import numpy as np
from numba import njit

from core.geometry import FloatArray
from core.sensing.ring import SonarRing
from core.sensing.robot_log import Scan
from core.simulation.home import Home
from core.simulation.odometry import OdometryErrors, SimulatedOdometry, advanced
from core.simulation.outline import Outline, outline_of
from core.simulation.sonar_model import SonarModel
from core.simulation.sonar_physics import SonarPhysics

SUBSTEP = 0.02
"""Motion is checked for collisions every so many metres."""


class SimulatedRobot:
    """A round robot with a ring of sonars in a home that may change under way.

    Attributes:
        home: as it is now.
        pose: true pose (3,) in the home's frame.
        t: seconds since the start.
        odometry: what its wheels believe.
        blocked: whether the last step ran into something.
    """

    def __init__(
        self,
        home: Home,
        ring: SonarRing,
        pose: FloatArray,
        odometry_start: FloatArray | None = None,
        *,
        errors: OdometryErrors,
        seed: int | list[int],
        sonar: SonarModel | None = None,
    ) -> None:
        """A robot at `pose`; its odometry starts at `odometry_start`, by default at the true pose."""
        sonar_rng, odometry_rng = np.random.default_rng(seed).spawn(2)
        self.ring = ring
        self.pose = np.array(pose, float)
        self.t = 0.0
        self.blocked = False
        self.odometry = SimulatedOdometry(
            errors, self.pose if odometry_start is None else odometry_start, odometry_rng
        )
        self._rng = sonar_rng
        self._model = sonar or SonarModel()
        self.enter(home)

    def enter(self, home: Home) -> None:
        """Puts another state of the home around the robot (a door shut, the sofa gone)."""
        self.home = home
        self._outline: Outline = outline_of(home)
        self._physics = SonarPhysics(self._outline, self.ring, self._model)

    def place(self, pose: FloatArray) -> None:
        """Carries the robot to another true pose; its odometry does not notice."""
        self.pose = np.array(pose, float)

    def step(self, speed: float, turn_rate: float, dt: float) -> Scan:
        """Drives for `dt` seconds with m/s and rad/s, then senses.

        A robot that runs into something stays where it is but still turns.
        """
        pieces = max(1, int(np.ceil(abs(speed) * dt / SUBSTEP)))
        distance, turn = speed * dt / pieces, turn_rate * dt / pieces
        self.blocked = False
        for _ in range(pieces):
            after = advanced(self.pose, distance, turn)
            if distance != 0.0 and not self._may_stand(after):
                self.blocked = True
                after = advanced(self.pose, 0.0, turn)
                self.odometry.move(0.0, turn)
            else:
                self.odometry.move(distance, turn)
            self.pose = after
        self.t += dt
        return self.sense()

    def sense(self) -> Scan:
        """One scan from where the robot stands now."""
        ranges = self._physics.scan(self.pose, self._rng)
        return Scan(self.t, self.odometry.pose.copy(), ranges, np.ones(len(self.ring), np.bool_))

    def _may_stand(self, pose: FloatArray) -> bool:
        """Whether the robot's disc is clear at `pose`, or at least clearer than where it is."""
        there = clearance_at(self._outline.faces, pose[0], pose[1])
        if there >= self.ring.robot_radius:
            return True
        return bool(there >= clearance_at(self._outline.faces, self.pose[0], self.pose[1]))


@njit(cache=True)
def clearance_at(faces: FloatArray, x: float, y: float) -> float:
    """Distance (m) from a point to the nearest face."""
    best = np.inf
    for i in range(len(faces)):
        ax, ay = faces[i, 0] - x, faces[i, 1] - y
        dx, dy = faces[i, 2] - faces[i, 0], faces[i, 3] - faces[i, 1]
        share = -(ax * dx + ay * dy) / max(dx * dx + dy * dy, 1e-12)
        share = min(max(share, 0.0), 1.0)
        best = min(best, (ax + share * dx) ** 2 + (ay + share * dy) ** 2)
    return float(np.sqrt(best))
