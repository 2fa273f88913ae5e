"""Puts the time stamps of a log in order: clocks that wrap, are set, jump, repeat or run backwards."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from core.errors import LogError
from core.geometry import BoolArray, FloatArray, IntArray
from core.log_readers.draft_log import Finding


def _wrap_periods() -> tuple[float, ...]:
    counters = [2.0**bits * unit for bits in (16, 24, 31, 32) for unit in (1e-3, 1e-6)]
    cut = [10.0**digits for digits in range(1, 10)]
    return tuple(sorted([*counters, *cut, 60.0, 3600.0, 43_200.0, 86_400.0]))


@dataclass(frozen=True)
class ClockConfig:
    """How a clock may misbehave.

    Attributes:
        wrap_periods: seconds after which clocks start again: counters of 16, 24, 31 and 32 bits in ms and
            us, cut decimal digits, minute, hour, half a day and day.
        step_s: after a wrap the next scan comes within this time.
        late_rows: so many scans in a row may come late; more, and the clock was set back.
        longest_gap_s: a longer step forward means that the clock was set.
        backward_share: more steps back than this share, and the time is no time.
        coarse_share: more equal times than this share, and the clock is coarse (whole seconds, say):
            equal times are then spread evenly; otherwise they are repeated scans.
    """

    wrap_periods: tuple[float, ...] = field(default_factory=_wrap_periods)
    step_s: float = 5.0
    late_rows: int = 2
    longest_gap_s: float = 3600.0
    backward_share: float = 0.05
    coarse_share: float = 0.2


@dataclass(frozen=True)
class OrderedTime:
    """Times (N,) in seconds that increase strictly where `keep` (N,), and what was done to get there.

    `changes` are findings about the clock, `skipped` about rows that are not kept.
    """

    t: FloatArray
    keep: BoolArray
    changes: tuple[Finding, ...] = ()
    skipped: tuple[Finding, ...] = ()


def ordered_time(
    t: FloatArray, lines: IntArray, source: str, config: ClockConfig = ClockConfig()
) -> OrderedTime:
    """Brings times (N,) of the rows at `lines` (N,) in order.

    Single late rows are dropped. Where the clock starts again by a known period, the period is added;
    where it was set back or forward, it goes on with the median step.

    Raises:
        LogError: the time runs backwards or stands still.
    """
    if len(t) < 2 or ((np.diff(t) > 0).all() and np.diff(t).max() <= config.longest_gap_s):
        return OrderedTime(t, np.ones(len(t), bool))
    steps = np.diff(t)
    _refuse_nonsense(t, steps, lines, source, config)
    forward = steps[(steps > 0) & (steps <= config.longest_gap_s)]
    usual = float(np.median(forward)) if len(forward) else float(np.median(steps[steps > 0]))
    t, late, changes = _without_backward_steps(t, lines, source, usual, config)
    t, jumped = _without_long_steps(t, late, usual, config)
    if len(jumped):
        changes.append(Finding.at("clock jumped ahead; the time goes on", lines[jumped], source))
    t, repeated, coarse = _without_equal_times(t, late, usual, config)
    if coarse:
        changes.append(Finding("equal times of a coarse clock, spread evenly", coarse, (), source))
    skipped = tuple(
        Finding.at(what, lines[rows], source)
        for what, rows in (
            ("late: time before that of an earlier row", np.flatnonzero(late)),
            ("repeated: same time as the row before", np.flatnonzero(repeated)),
        )
        if len(rows)
    )
    return OrderedTime(t, ~(late | repeated), tuple(changes), skipped)


def _refuse_nonsense(
    t: FloatArray, steps: FloatArray, lines: IntArray, source: str, config: ClockConfig
) -> None:
    back = np.flatnonzero(steps < 0)
    if len(back) > 1 and len(back) > config.backward_share * len(steps):
        first = back[0]
        raise LogError(
            f"time runs backwards (from {t[first]:.10g} to {t[first + 1]:.10g} s, and in "
            f"{len(back)} of {len(steps)} rows); the rows must be in order of time",
            source,
            int(lines[first + 1]),
        )
    if not (steps > 0).any():
        raise LogError(f"the time does not advance in any of {len(t)} rows", source, int(lines[1]))


def _without_backward_steps(
    t: FloatArray, lines: IntArray, source: str, usual: float, config: ClockConfig
) -> tuple[FloatArray, BoolArray, list[Finding]]:
    """Times with wraps and resets undone, which rows are late, and findings."""
    late = np.zeros(len(t), bool)
    offset = np.zeros(len(t))
    changes = []
    last = 0
    for i in np.flatnonzero(np.diff(t) < 0) + 1:
        if i <= last:
            continue
        before = t[i - 1]
        ahead = np.flatnonzero(t[i : i + config.late_rows + 1] >= before)
        if len(ahead) or len(t) - i == 1:
            last = int(i) + (int(ahead[0]) if len(ahead) else 1)
            late[i:last] = True
            continue
        period = _wrap_period(float(before), float(t[i]), config)
        shift = before + usual - t[i] if period is None else period
        offset[i:] += shift
        what = "set back" if period is None else "started again"
        changes.append(
            Finding.at(
                f"clock {what} by {before - t[i]:.6g} s; the time goes on", [lines[i]], source
            )
        )
    return t + offset, late, changes


def _wrap_period(before: float, after: float, config: ClockConfig) -> float | None:
    """The period of a counter that runs from 0 (or, signed, from minus half its period) and that went
    from `before` to `after` when it started again, or None."""
    for period in config.wrap_periods:
        for start in (0.0, -period / 2):
            top = start + period - config.step_s <= before <= start + period
            if top and start <= after <= start + config.step_s and after + period > before:
                return period
    return None


def _without_long_steps(
    t: FloatArray, late: BoolArray, usual: float, config: ClockConfig
) -> tuple[FloatArray, IntArray]:
    """Times with steps of hours replaced by the usual step, and the rows after those."""
    kept = np.flatnonzero(~late)
    steps = np.diff(t[kept])
    long = steps > max(config.longest_gap_s, usual)
    out = t.copy()
    out[kept[1:]] -= np.cumsum(np.where(long, steps - usual, 0.0))
    return out, kept[1:][long]


def _without_equal_times(
    t: FloatArray, late: BoolArray, usual: float, config: ClockConfig
) -> tuple[FloatArray, BoolArray, int]:
    """Times that increase strictly, which rows are repeats, and how many equal times were spread."""
    kept = np.flatnonzero(~late)
    steps = np.diff(t[kept])
    repeated = np.zeros(len(t), bool)
    equal = int((steps <= 0).sum())
    if equal <= config.coarse_share * len(steps):
        repeated[kept[1:][steps <= 0]] = True
        return t, repeated, 0
    starts = np.flatnonzero(np.concatenate(([True], steps > 0)))
    counts = np.diff(np.append(starts, len(kept)))
    values = t[kept][starts]
    tick = np.append(np.diff(values), usual)
    place = np.arange(len(kept)) - np.repeat(starts, counts)
    out = t.copy()
    out[kept] = np.repeat(values, counts) + place * np.repeat(
        np.minimum(tick, usual) / counts, counts
    )
    return out, repeated, equal
