from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.errors import LogError
from core.log_readers.clock import OrderedTime, ordered_time

STEADY = np.arange(100) * 0.25


def ordered(t: np.ndarray) -> OrderedTime:
    return ordered_time(t, np.arange(len(t)) + 2, "log")


def test_a_good_clock_is_left_alone() -> None:
    result = ordered(STEADY)
    assert result.t is STEADY
    assert result.keep.all()
    assert result.changes == result.skipped == ()


@pytest.mark.parametrize("period", [65.536, 4294967.296, 3600.0, 86400.0, 100.0])
def test_a_clock_that_wraps_goes_on_where_it_would_be(period: float) -> None:
    true = STEADY + period - 10
    result = ordered(true % period)
    np.testing.assert_allclose(result.t, true, atol=1e-6)
    assert [(f.count, f.lines) for f in result.changes] == [(1, (42,))]
    assert "started again" in result.changes[0].what


def test_a_clock_that_is_set_back_goes_on_with_the_usual_step() -> None:
    t = STEADY.copy()
    t[60:] -= 7.3
    result = ordered(t)
    np.testing.assert_allclose(result.t, STEADY)
    assert result.keep.all()
    assert "set back by 7.05 s" in result.changes[0].what


def test_a_clock_that_is_set_ahead_by_years_goes_on_with_the_usual_step() -> None:
    t = STEADY.copy()
    t[60:] += 1.7e9
    result = ordered(t)
    np.testing.assert_allclose(result.t, STEADY, atol=1e-5)
    assert "jumped ahead" in result.changes[0].what


def test_a_pause_of_a_minute_stays_a_pause() -> None:
    t = STEADY.copy()
    t[60:] += 60
    assert ordered(t).t is t


def test_a_late_row_is_left_out() -> None:
    t = STEADY.copy()
    t[50] = t[48] - 0.1
    result = ordered(t)
    assert np.flatnonzero(~result.keep).tolist() == [50]
    assert [(f.what[:4], f.lines) for f in result.skipped] == [("late", (52,))]


def test_a_repeated_row_is_left_out() -> None:
    result = ordered(np.insert(STEADY, 10, STEADY[10]))
    assert np.flatnonzero(~result.keep).tolist() == [11]
    assert result.skipped[0].what.startswith("repeated")


def test_equal_times_of_a_clock_of_whole_seconds_are_spread() -> None:
    result = ordered(np.floor(STEADY))
    assert result.keep.all()
    np.testing.assert_allclose(result.t, STEADY)
    assert result.changes[0].count == 75


@pytest.mark.parametrize(
    ("t", "line"), [(STEADY[::-1], 3), (np.array([2.0, 1.0, 0.0]), 3), (np.ones(9), 3)]
)
def test_time_that_runs_backwards_or_stands_still_is_refused(t: np.ndarray, line: int) -> None:
    with pytest.raises(LogError, match="time") as caught:
        ordered(t)
    assert caught.value.line == line


@settings(max_examples=200, deadline=None)
@given(
    st.lists(
        st.one_of(st.integers(-3, 8), st.sampled_from((-1000, 7000, 10**9))).map(float),
        min_size=1,
        max_size=40,
    )
)
def test_whatever_the_clock_does_the_kept_times_increase(steps: list[float]) -> None:
    t = np.cumsum([0.0, *steps])
    try:
        result = ordered(t)
    except LogError:
        return
    assert (np.diff(result.t[result.keep]) > 0).all()
    assert result.keep[0]
