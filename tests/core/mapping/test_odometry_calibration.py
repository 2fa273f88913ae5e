"""Findings about the odometry in words."""

from __future__ import annotations

import math

from core.mapping.odometry_calibration import OdometryCalibration


def test_a_clear_turn_error_is_told_with_its_uncertainty() -> None:
    found = OdometryCalibration(0.001, 0.021, 0.0, 0.004, 0.002, 0.001).sentences()

    assert found == ("Your robot turns 2.1 % more than its odometry says (±0.2 %).",)


def test_drift_to_the_right_is_told() -> None:
    found = OdometryCalibration(0.0, 0.0, math.radians(-0.25), 0.004, 0.002, math.radians(0.05))

    assert "to the right by 0.25 degrees a metre" in found.sentences()[0]


def test_unclear_errors_are_not_told() -> None:
    found = OdometryCalibration(0.003, 0.003, 0.001, 0.004, 0.002, 0.001).sentences()

    assert found == ("No systematic error of the odometry stands out in this log.",)
