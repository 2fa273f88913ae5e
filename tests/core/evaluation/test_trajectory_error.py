"""Trajectory errors with and without a rigid fit."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.evaluation import trajectory_error
from core.geometry import compose

TRUTH = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, math.pi / 2]], float)


def test_no_error() -> None:
    error = trajectory_error(TRUTH, TRUTH)
    assert (error.mean, error.at_end, error.heading_mean) == (0.0, 0.0, 0.0)


def test_a_known_offset_at_the_end() -> None:
    poses = TRUTH.copy()
    poses[-1] += (0.3, 0.4, -0.1)
    error = trajectory_error(poses, TRUTH)
    assert error.mean == pytest.approx(0.5 / 4)
    assert error.median == 0.0
    assert error.rmse == pytest.approx(0.25)
    assert (error.largest, error.at_end) == pytest.approx((0.5, 0.5))
    assert error.heading_at_end == pytest.approx(-0.1)
    assert error.heading_mean == pytest.approx(0.1 / 4)


def test_a_fit_takes_a_rigid_motion_away() -> None:
    poses = compose(np.array([3.0, -2.0, 1.0]), TRUTH)
    assert trajectory_error(poses, TRUTH).mean > 1.0
    fitted = trajectory_error(poses, TRUTH, fitted=True)
    assert fitted.largest == pytest.approx(0.0, abs=1e-9)
    assert fitted.heading_mean == pytest.approx(0.0, abs=1e-9)


def test_headings_are_compared_around_the_circle() -> None:
    truth = np.array([[0.0, 0.0, math.pi - 0.05]])
    poses = np.array([[0.0, 0.0, -math.pi + 0.05]])
    assert trajectory_error(poses, truth).heading_at_end == pytest.approx(0.1)
