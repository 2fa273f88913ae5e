"""Drifting odometry."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.errors import UsageError
from core.simulation.odometry import ODOMETRY, SimulatedOdometry, advanced, odometry_errors

START = np.array([1.0, 2.0, math.pi / 2])


def driven(name: str, seed: int, steps: list[tuple[float, float]]) -> np.ndarray:
    odometry = SimulatedOdometry(ODOMETRY[name], START, np.random.default_rng(seed))
    for distance, turn in steps:
        odometry.move(distance, turn)
    return odometry.pose


def test_without_errors_it_is_the_motion_itself() -> None:
    pose = driven("none", 0, [(2.0, 0.0), (0.0, -math.pi / 2), (3.0, 0.0)])
    assert pose == pytest.approx((4.0, 4.0, 0.0), abs=1e-12)


def test_an_arc_of_a_quarter_circle_ends_where_geometry_says() -> None:
    pose = advanced(np.zeros(3), math.pi / 2, math.pi / 2)
    assert pose == pytest.approx((1.0, 1.0, math.pi / 2))


@pytest.mark.parametrize("name", ["calibrated", "bad"])
def test_errors_have_the_spread_of_the_table(name: str) -> None:
    errors = ODOMETRY[name]
    straight = [(0.1, 0.0)] * 100  # 10 m
    ends = np.array([driven(name, seed, straight) for seed in range(400)])
    along = ends[:, 1] - START[1] - 10.0
    heading = ends[:, 2] - START[2]
    expected = math.hypot(10 * errors.drift_per_metre, math.sqrt(10) * errors.random_turn)
    assert heading.std() == pytest.approx(expected, rel=0.12)
    scale = math.hypot(10 * errors.distance_scale, math.sqrt(10) * errors.random_distance)
    assert np.median(np.abs(along)) == pytest.approx(0.6745 * scale, rel=0.25)


def test_turn_scale_is_systematic_within_a_drive() -> None:
    once = driven("bad", 3, [(0.0, 1.0)])[2] - START[2] - 1.0
    twice = driven("bad", 3, [(0.0, 1.0), (0.0, -1.0), (0.0, 1.0)])[2] - START[2] - 1.0
    assert once == pytest.approx(twice)
    assert abs(once) > 1e-4


def test_a_jump_moves_the_pose_ahead() -> None:
    odometry = SimulatedOdometry(ODOMETRY["none"], START, np.random.default_rng(0))
    odometry.jump(np.array([1.0, 0.0, 0.0]))
    assert odometry.pose == pytest.approx((1.0, 3.0, math.pi / 2))


def test_an_unknown_name_is_a_usage_error() -> None:
    with pytest.raises(UsageError, match="none, calibrated, bad"):
        odometry_errors("good")
