"""A camera that goes with a robot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.viewer.camera import View
from core.geometry import FloatArray

FOLLOWED_REACH = 3.2
"""Metres from the middle of the picture to its upper rim at most, as a robot begins to be followed."""
FOLLOWED_FROM = np.deg2rad(72.0)
"""Elevation from which it is seen at least then: walls hide it from eyes further down."""


def following(view: View, pose: FloatArray, begins: bool) -> View:
    """Where a camera at `view` goes with the robot at a pose (3,); `begins`: it did not before."""
    return _centred(_over_walls(view) if begins else view, pose)


def _over_walls(view: View) -> View:
    """A view from the same side, nearer and from higher up, as far as it is not already."""
    offset = np.subtract(view.position, view.look_at)
    distance = float(np.linalg.norm(offset))
    elevation = max(float(np.arcsin(offset[2] / distance)), FOLLOWED_FROM)
    azimuth = float(np.arctan2(offset[1], offset[0]))
    reach = min(distance, FOLLOWED_REACH / float(np.tan(view.fov / 2)))
    level = reach * np.cos(elevation)
    moved = (level * np.cos(azimuth), level * np.sin(azimuth), reach * np.sin(elevation))
    return replace(view, position=_triple(np.add(view.look_at, moved)))


def _centred(view: View, pose: FloatArray) -> View:
    """The view with the robot in its middle."""
    middle = np.array([pose[0], pose[1], 0.0])
    offset = np.subtract(view.position, view.look_at)
    return replace(view, position=_triple(middle + offset), look_at=_triple(middle))


def _triple(values: FloatArray) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return (x, y, z)
