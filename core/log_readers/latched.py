"""Which readings only repeat an earlier measurement.

Sonars that fire in turn keep ("latch") their last value, and a logger that runs faster than the ring
writes it again, at poses where nothing was measured. In a channel that does so a value stays exactly the
same for some rows and then changes by a lot; a sensor that measures every row changes at every row
where it changes fast. So only stretches between two large changes are asked: quantised readings of a
slow robot (small changes) and a wall beside the drive (no changes) are no evidence, and neither are
stretches of no echo.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import BoolArray, FloatArray, IntArray


@dataclass(frozen=True)
class LatchConfig:
    """When a channel is taken to latch its values.

    On the logs of four independently simulated homes (1 cm steps, every value measured) at most 17 % of
    the stretches of a channel are longer than one row; on a real log of sonars that fire in turn 73-89 %.

    Attributes:
        change_m: a large change is more than this ...
        change_steps: ... and more than so many steps of the sensor's resolution.
        resolution_percentile: the resolution is this percentile of the steps between a channel's values.
        share: a channel latches when this share of its stretches is longer than one row.
        stretches: fewer stretches are no evidence; the ring as a whole then decides for the channel.
    """

    change_m: float = 0.025
    change_steps: float = 2.5
    resolution_percentile: float = 25.0
    share: float = 0.4
    stretches: int = 15


def measured_anew(ranges: FloatArray, config: LatchConfig = LatchConfig()) -> BoolArray:
    """False (N, S) where a value of `ranges` (N, S) repeats the one before without being measured.

    In a latching channel the first of a run of equal values (or of no echoes) is a measurement, and
    then every p-th, p being the median length of the runs between large changes: along a wall, new
    measurements do give the same value.
    """
    fresh = np.ones(ranges.shape, bool)
    evidence = [_stretch_lengths(ranges[:, i], config) for i in range(ranges.shape[1])]
    pooled = np.concatenate(evidence) if evidence else np.zeros(0, int)
    for i, lengths in enumerate(evidence):
        judged = lengths if len(lengths) >= config.stretches else pooled
        if len(judged) >= config.stretches and (judged > 1).mean() >= config.share:
            period = max(int(np.median(judged)), 2)
            fresh[:, i] = _place_in_run(ranges[:, i]) % period == 0
    return fresh


def _stretch_lengths(values: FloatArray, config: LatchConfig) -> IntArray:
    """Lengths of the runs of one channel (N,) that lie between two large changes."""
    spacing = np.diff(np.unique(values[np.isfinite(values)]))
    if not len(spacing):
        return np.zeros(0, np.int64)
    resolution = float(np.percentile(spacing, config.resolution_percentile))
    large = max(config.change_m, config.change_steps * resolution)
    starts = _run_starts(values)
    with np.errstate(invalid="ignore"):
        jumps = np.abs(np.diff(values[starts])) > large
    between = np.flatnonzero(jumps[:-1] & jumps[1:]) + 1
    return np.diff(np.append(starts, len(values)))[between]


def _run_starts(values: FloatArray) -> IntArray:
    """Where the runs of equal values (NaN equals NaN) of (N,) start."""
    before, after = values[:-1], values[1:]
    same = (before == after) | (np.isnan(before) & np.isnan(after))
    return np.flatnonzero(np.concatenate((np.ones(min(len(values), 1), bool), ~same)))


def _place_in_run(values: FloatArray) -> IntArray:
    """Place (N,) of each value in its run, 0 for the first."""
    starts = _run_starts(values)
    lengths = np.diff(np.append(starts, len(values)))
    return np.arange(len(values)) - np.repeat(starts, lengths)
