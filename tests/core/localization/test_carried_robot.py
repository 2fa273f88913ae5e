"""Readings from two places in one step."""

from __future__ import annotations

import numpy as np
import pytest

from core.localization.carried_robot import chance_carried, mixed
from core.localization.pose_grid import PoseBelief

SHAPE = (4, 10, 10)


def at(pose: tuple[int, int, int]) -> PoseBelief:
    mass = np.zeros(SHAPE, np.float32)
    mass[pose] = 1.0
    return PoseBelief(mass, 0.0)


ANYWHERE = PoseBelief(np.full(SHAPE, 1 / 400, np.float32), 0.0)


def test_readings_that_say_nothing_leave_the_suspicion_as_it_was() -> None:
    chance = chance_carried(at((0, 1, 1)), ANYWHERE, np.zeros(SHAPE, np.float32), 0.2, 0.3)
    assert chance == pytest.approx(0.3, abs=1e-6)


def test_a_place_that_fits_elsewhere_speaks_for_having_been_carried() -> None:
    score = np.zeros(SHAPE, np.float32)
    score[2, 8, 8] = 60.0  # e^12 times as likely as where the belief is, in one pose of 400
    chance = chance_carried(at((0, 1, 1)), ANYWHERE, score, 0.2, 0.3)
    odds = 0.3 * (np.exp(12.0) + 399) / 400 / 0.7
    assert chance == pytest.approx(odds / (1 + odds), rel=1e-4)


def test_readings_that_fit_nowhere_say_nothing() -> None:
    score = np.full(SHAPE, -np.inf, np.float32)
    assert chance_carried(at((0, 1, 1)), ANYWHERE, score, 0.2, 0.3) == 0.0


def test_a_mixture_sums_to_one() -> None:
    both = mixed(at((0, 1, 1)), PoseBelief(ANYWHERE.mass * np.float32(0.9), 0.1), 0.25)
    assert both.mass.sum(dtype=float) + both.unknown == pytest.approx(1.0, abs=1e-6)
    assert both.unknown == pytest.approx(0.025)
    assert both.mass[0, 1, 1] == pytest.approx(0.75, abs=1e-3)
