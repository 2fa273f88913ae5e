from __future__ import annotations

import numpy as np
import pytest

from core.log_readers.latched import measured_anew


def approach(rows: int, step: float, noise: float, seed: int) -> np.ndarray:
    """Ranges (rows, 4) in whole centimetres of a robot that drives to and fro before walls."""
    rng = np.random.default_rng(seed)
    phase = np.arange(rows)[:, None] * step + np.array([0.3, 0.9, 1.4, 2.2])
    exact = 0.5 + np.abs((phase % 4.0) - 2.0)
    return np.round(exact + rng.normal(0, noise, exact.shape), 2)


def latch(ranges: np.ndarray, period: int) -> np.ndarray:
    """What a logger sees of sonars that fire in turn, each every `period` rows."""
    rows = np.arange(len(ranges))[:, None]
    fired = rows - (rows + np.arange(ranges.shape[1])) % period
    return np.take_along_axis(ranges, np.maximum(fired, 0), axis=0)


@pytest.mark.parametrize("period", [2, 4, 8])
def test_values_that_repeat_because_sonars_fire_in_turn_are_stale(period: int) -> None:
    fresh = measured_anew(latch(approach(600, 0.05, 0.01, 1), period))
    rows = np.arange(period, 600)
    fired = (rows[:, None] + np.arange(4)) % period == 0
    agree = (fresh[period:] == fired).mean()
    assert agree > 0.95
    assert fresh.mean() == pytest.approx(1 / period, abs=0.05)


@pytest.mark.parametrize("step", [0.0, 0.002, 0.01, 0.04])
@pytest.mark.parametrize("noise", [0.0, 0.004, 0.02])
def test_rounding_a_slow_robot_or_one_that_stands_is_no_evidence(step: float, noise: float) -> None:
    assert measured_anew(approach(600, step, noise, 2)).all()


def test_a_coarse_sensor_is_no_evidence() -> None:
    assert measured_anew(np.round(approach(600, 0.02, 0.0, 3) * 10) / 10).all()


def test_stretches_without_echo_are_no_evidence() -> None:
    ranges = approach(600, 0.05, 0.01, 4)
    ranges[np.arange(600) % 10 < 6] = np.nan
    assert measured_anew(ranges).all()


def test_in_a_latching_channel_no_echo_is_measured_every_period() -> None:
    ranges = latch(approach(600, 0.05, 0.01, 5), 2)
    ranges[300:400] = np.nan
    assert measured_anew(ranges)[300:400].sum(axis=0).tolist() == [50, 50, 50, 50]


def test_the_ring_decides_for_a_channel_that_says_little() -> None:
    ranges = latch(approach(600, 0.05, 0.01, 6), 2)
    ranges[20:, 3] = np.nan
    ranges[100:104, 3] = 1.0
    assert measured_anew(ranges)[100:104, 3].tolist() == [True, False, True, False]


def test_one_latching_channel_does_not_spoil_the_others() -> None:
    ranges = approach(600, 0.05, 0.01, 7)
    ranges[:, 2] = latch(ranges, 2)[:, 2]
    assert measured_anew(ranges).mean(axis=0) == pytest.approx([1, 1, 0.5, 1], abs=0.05)


def test_a_log_of_one_scan_is_fresh() -> None:
    assert measured_anew(np.array([[1.0, np.nan]])).all()
