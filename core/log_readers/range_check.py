"""Which ranges can be what a sonar of the ring measured."""

from __future__ import annotations

import numpy as np

from core.geometry import BoolArray, FloatArray
from core.sensing.ring import SonarRing

BEYOND_TOLERANCE = 0.02
"""A reading may exceed the sonar's range by this share (noise on the last centimetres)."""


def usable_ranges(ranges: FloatArray, ring: SonarRing) -> FloatArray:
    """Ranges (..., S) in which everything that is no echo is NaN.

    No echo is: NaN, infinite, zero, negative, or beyond the sonar's `max_range`. A value between 0
    and `min_range` stays: something is there.
    """
    return np.where(impossible(ranges, ring) | ~np.isfinite(ranges), np.nan, ranges)


def impossible(ranges: FloatArray, ring: SonarRing) -> BoolArray:
    """Finite ranges (..., S) that the sonar cannot have measured."""
    farthest = np.array([sonar.max_range for sonar in ring.sonars]) * (1 + BEYOND_TOLERANCE)
    with np.errstate(invalid="ignore"):
        return np.isfinite(ranges) & ((ranges <= 0) | (ranges > farthest))
