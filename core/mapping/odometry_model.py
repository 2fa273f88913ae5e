"""What odometry does wrong: three systematic errors and a random walk.

`true motion = odometry's motion` with the distance scaled by `1 + distance_scale`, the turn scaled by
`1 + turn_scale`, and `drift_per_metre` added to the heading for each metre driven. What remains is
random and grows with the square root of the distance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray, IntArray, between, compose, wrap_angle

NO_CORRECTION = np.zeros(3)
"""Systematic errors (distance scale, turn scale, drift per metre) of perfect odometry."""


@dataclass(frozen=True)
class OdometryNoise:
    """Standard deviations of the errors before the log; unless said otherwise those of any robot.

    Attributes:
        distance_scale, turn_scale: systematic, shares.
        drift_per_metre: systematic, rad/m.
        position, heading: random, m and rad per square root of a metre.
        metres_per_radian: the distance that a turn counts for in the random errors.
        position_floor, heading_floor: random, m and rad per stretch.
        expected: the systematic errors themselves, where they are known of a robot (in that order).
    """

    distance_scale: float = 0.02
    turn_scale: float = 0.02
    drift_per_metre: float = math.radians(0.3)
    position: float = 0.015
    heading: float = math.radians(0.8)
    metres_per_radian: float = 0.1
    position_floor: float = 0.003
    heading_floor: float = 0.002
    expected: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def systematic(self) -> FloatArray:
        """(3,) standard deviations of distance scale, turn scale, drift per metre."""
        return np.array([self.distance_scale, self.turn_scale, self.drift_per_metre])


def motions(poses: FloatArray) -> FloatArray:
    """(N - 1, 3) motion of each step, seen from its start."""
    return between(poses[:-1], poses[1:])


def integrate(start: FloatArray, steps: FloatArray) -> FloatArray:
    """Poses (N, 3) from the first one and the N - 1 motions (inverse of `motions`)."""
    heading = start[2] + np.concatenate(([0.0], np.cumsum(steps[:, 2])))
    c, s = np.cos(heading[:-1]), np.sin(heading[:-1])
    x = start[0] + np.concatenate(([0.0], np.cumsum(c * steps[:, 0] - s * steps[:, 1])))
    y = start[1] + np.concatenate(([0.0], np.cumsum(s * steps[:, 0] + c * steps[:, 1])))
    return np.stack((x, y, wrap_angle(heading)), axis=1)


def without_systematic_error(poses: FloatArray, error: FloatArray) -> FloatArray:
    """Odometry poses (N, 3) with the systematic errors (3,) taken out; the first pose stays."""
    steps = motions(poses)
    distance = np.hypot(steps[:, 0], steps[:, 1])
    steps[:, :2] *= 1 + error[0]
    steps[:, 2] = steps[:, 2] * (1 + error[1]) + error[2] * distance
    return integrate(poses[0], steps)


def through_nodes(
    poses: FloatArray, length: FloatArray, nodes: IntArray, node_poses: FloatArray
) -> FloatArray:
    """A trajectory that passes through corrected poses and follows the odometry in between.

    Between two nodes each scan is carried along from both, and the two are blended by travel.

    Args:
        poses: (N, 3) odometry.
        length: (N,) travel at the scans, metres.
        nodes: (K,) scan indices of the nodes, ascending, K >= 2; the first and last scan among them.
        node_poses: (K, 3) their corrected poses.
    """
    left = np.clip(np.searchsorted(nodes, np.arange(len(poses)), "right") - 1, 0, len(nodes) - 2)
    a, b = nodes[left], nodes[left + 1]
    share = np.clip((length - length[a]) / np.maximum(length[b] - length[a], 1e-9), 0.0, 1.0)
    from_a = compose(node_poses[left], between(poses[a], poses))
    from_b = compose(node_poses[left + 1], between(poses[b], poses))
    out = from_a + share[:, None] * (from_b - from_a)
    out[:, 2] = wrap_angle(from_a[:, 2] + share * wrap_angle(from_b[:, 2] - from_a[:, 2]))
    return out
