"""A camera that goes with a robot keeps its side and its distance, and sees over the walls."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.viewer.camera import View
from app.viewer.following import FOLLOWED_FROM, FOLLOWED_REACH, following

POSE = np.array([2.0, 3.0, 0.5])


def seen_from(x: float, y: float, z: float) -> View:
    """A camera there that looks at the origin."""
    return View((x, y, z), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), math.radians(40))


def test_the_robot_is_in_the_middle_and_the_camera_keeps_its_distance():
    view = following(seen_from(0.0, -3.0, 4.0), POSE, begins=False)
    assert view.look_at == (2.0, 3.0, 0.0)
    assert view.position == pytest.approx((2.0, 0.0, 4.0))


def test_a_camera_that_begins_comes_nearer_and_rises_on_its_own_side():
    view = following(seen_from(0.0, -60.0, 30.0), POSE, begins=True)
    offset = np.subtract(view.position, view.look_at)
    distance = float(np.linalg.norm(offset))
    assert offset[0] == pytest.approx(0.0, abs=1e-9)
    assert offset[1] < 0
    assert math.asin(offset[2] / distance) == pytest.approx(FOLLOWED_FROM)
    assert distance * math.tan(view.fov / 2) == pytest.approx(FOLLOWED_REACH)


def test_a_camera_that_is_near_and_high_already_stays_so():
    view = following(seen_from(0.0, -0.1, 3.0), POSE, begins=True)
    assert view.position == pytest.approx((2.0, 2.9, 3.0))
