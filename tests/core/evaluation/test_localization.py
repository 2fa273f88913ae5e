"""Figures of a localization from steps that can be counted by hand."""

from __future__ import annotations

import numpy as np
import pytest

from core.evaluation.localization import (
    StepOutcome,
    calibration_error,
    converged_after,
    driven_metres,
    reliability,
    summary,
)


def outcome(t: float, right: bool, probability: float) -> StepOutcome:
    return StepOutcome(t, 2.5 * t, right, probability, probability if right else 0.0, 0.0, 0.1)


DRIVE = [
    outcome(1, False, 0.5),
    outcome(2, False, 0.95),
    outcome(3, True, 0.8),
    outcome(4, True, 0.95),
]


def test_summary_of_four_steps() -> None:
    score = summary([DRIVE])
    assert score.accuracy == 0.5
    assert score.false_certain == 0.25
    assert score.converged_m == 10.0
    assert score.position_error == pytest.approx(0.1)


def test_recovery_counts_from_where_the_robot_was_carried() -> None:
    assert converged_after(DRIVE, since=3.0, start=6.0) == pytest.approx(4.0)
    assert converged_after(DRIVE[:2]) == np.inf


def test_being_carried_is_no_driving() -> None:
    path = np.array([[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [5.0, 0.0, 0.0], [5.0, 0.5, 0.0]])
    assert driven_metres(path).tolist() == [0.0, 0.5, 0.5, 1.0]


def test_calibration_error_is_the_weighted_distance_from_the_diagonal() -> None:
    probabilities = np.array([0.95, 0.95, 0.95, 0.95, 0.55, 0.55])
    right = np.array([True, True, True, False, True, False])
    rows = reliability(probabilities, right)
    assert rows[9].tolist() == pytest.approx([0.95, 0.75, 4])
    assert calibration_error(probabilities, right) == pytest.approx((4 * 0.2 + 2 * 0.05) / 6)


def test_nothing_scored_is_nothing_right() -> None:
    assert summary([]).steps == 0
