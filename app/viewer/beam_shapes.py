"""The sonar beams of a scan: where they point, how far they reach, and which came back."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from app.viewer.contour_mesh import Mesh
from app.viewer.palette import Colour
from core.geometry import FloatArray, compose
from core.sensing.ring import SonarRing

ECHO: Colour = (240, 122, 16)
MISS: Colour = (96, 134, 196)
MISS_SHARE = 0.3
"""Width of a beam without an echo against one with: they are long, and would cover the map."""
ARC_THICKNESS = 0.02
"""Of an arc at 1 m, metres; it grows with the range as the beam does."""
PIECES = 10
UNSEEN = 1e-4
"""Scale of what is not there; viser does not take 0."""


@dataclass(frozen=True)
class BeamPlan:
    """The S beams of one scan.

    Attributes:
        feet: (S, 2) the transducers in the world.
        headings: (S,) rad, in the world.
        reaches: (S,) metres: the reading, or the longest that could have been.
        shape_width: of the shape that all of them are drawn with (rad).
        widths: (S,) of each beam against it.
        echoes: (S,) whether it came back.
    """

    feet: FloatArray
    headings: FloatArray
    reaches: FloatArray
    shape_width: float
    widths: FloatArray
    echoes: np.ndarray

    def scales(self, shown: np.ndarray) -> FloatArray:
        """(S, 3) of the shapes; those that are not shown vanish."""
        across = self.reaches * self.widths * np.where(self.echoes, 1.0, MISS_SHARE)
        scales = np.column_stack((self.reaches, across, np.ones(len(across))))
        return np.where(shown[:, None], scales, UNSEEN)


def plan_beams(ring: SonarRing, pose: FloatArray, ranges: FloatArray) -> BeamPlan:
    """The beams of the readings (S,) at the robot's pose (3,) in the world."""
    mounts = np.array([(s.x, s.y, s.heading) for s in ring.sonars])
    world = np.array([compose(pose, mount) for mount in mounts])
    echoes = np.isfinite(ranges)
    longest = np.array([s.max_range for s in ring.sonars])
    halves = np.array([s.beam_width / 2 for s in ring.sonars])
    return BeamPlan(
        world[:, :2],
        world[:, 2],
        np.where(echoes, ranges, longest),
        float(2 * halves[0]),
        np.sin(halves) / np.sin(halves[0]),
        echoes,
    )


@cache
def fan(width: float) -> Mesh:
    """A level sector of radius 1 about +x, `width` rad wide."""
    turn = np.linspace(-width / 2, width / 2, PIECES + 1)
    rim = np.column_stack((np.cos(turn), np.sin(turn), np.zeros(PIECES + 1)))
    vertices = np.vstack((np.zeros((1, 3)), rim)).astype(np.float32)
    faces = np.array([(0, i, i + 1) for i in range(1, PIECES + 1)], np.uint32)
    return Mesh(vertices, faces)


@cache
def arc(width: float) -> Mesh:
    """A level strip along the rim of `fan`."""
    turn = np.linspace(-width / 2, width / 2, PIECES + 1)
    rim = np.column_stack((np.cos(turn), np.sin(turn), np.zeros(PIECES + 1)))
    inner, outer = rim * (1 - ARC_THICKNESS), rim * (1 + ARC_THICKNESS)
    vertices = np.vstack((inner, outer)).astype(np.float32)
    first = np.arange(PIECES)
    low = np.column_stack((first, first + PIECES + 1, first + PIECES + 2))
    high = np.column_stack((first, first + PIECES + 2, first + 1))
    return Mesh(vertices, np.vstack((low, high)).astype(np.uint32))
