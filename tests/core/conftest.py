"""Small drives whose maps are known."""

from __future__ import annotations

import numpy as np
import pytest

from core.geometry import compose
from core.sensing import RobotLog, Sonar, SonarRing

HALF_SIDE = 1.5
"""Metres from the middle of the square room to its walls."""


def exact_range(pose: np.ndarray, half_side: float, half_beam: float) -> float:
    """Distance to the nearest wall point of a square room within a beam."""
    best = np.inf
    for angle in pose[2] + np.linspace(-half_beam, half_beam, 41):
        direction = np.array([np.cos(angle), np.sin(angle)])
        for axis in (0, 1):
            if abs(direction[axis]) > 1e-9:
                wall = np.sign(direction[axis]) * half_side
                best = min(best, (wall - pose[axis]) / direction[axis])
    return float(best)


@pytest.fixture(scope="session")
def square_room() -> RobotLog:
    """A drive round the inside of an empty square room of 3 m with exact ranges."""
    sonars = tuple(
        Sonar(0.2 * np.cos(a), 0.2 * np.sin(a), float(a), 0.6, 0.1, 4.0)
        for a in np.arange(8) * np.pi / 4
    )
    ring = SonarRing(sonars, 0.22)
    side = np.linspace(-0.9, 0.9, 19)
    poses = np.array(
        [(x, -0.9, 0.0) for x in side]
        + [(0.9, y, np.pi / 2) for y in side]
        + [(-x, 0.9, np.pi) for x in side]
        + [(-0.9, -y, -np.pi / 2) for y in side]
    )
    mounting = np.array([(s.x, s.y, s.heading) for s in sonars])
    ranges = np.array(
        [[exact_range(compose(p, m), HALF_SIDE, 0.3) for m in mounting] for p in poses]
    )
    return RobotLog(
        "square room",
        ring,
        np.arange(len(poses)) * 0.25,
        poses,
        ranges,
        np.ones(ranges.shape, bool),
    )
