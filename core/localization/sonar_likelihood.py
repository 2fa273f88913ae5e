"""How likely a reading is where a surface is expected: a beam model for wide, specular sonar.

A reading z against the expected range d of the nearest surface in the beam is one of four things
(after Thrun, Burgard and Fox 2005, Sect. 6.3): an echo of that surface; an echo of something in
front of it that the map has not (a person, a chair, cross-talk); an echo of something behind it,
because the surface turned the sound away; or anything. No echo is a fifth.

A wide beam meets many surfaces. Most echoes come from the nearest of them or from the one on the
axis, so the reading is a mixture over these two (together they tell a third more about the place
than either, measured on simulated homes).

The table holds likelihood *ratios* against a place of which nothing is known, where the reading
is as likely as at an average place of this map. A place outside the map therefore has the ratio 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from core.geometry import BoolArray, FloatArray, IntArray
from core.localization.expected_range import NOTHING, OPEN, RANGE_STEP, ByteArray

NO_ECHO = 128
"""Reading code of a sonar that heard nothing; 0..127 are units of `RANGE_STEP`."""
CODES = 256
INSIDE = 0
"""Expected range code of places that are no free ground."""
TINY = 1e-9

Table = npt.NDArray[np.float32]
"""(NO_ECHO + 1, 2, CODES): likelihood ratio by reading code, surface (nearest in the beam, on its
axis) and expected range code; the ratio of a reading is the sum over the two surfaces."""


@dataclass(frozen=True)
class SonarLikelihoodConfig:
    """The beam model; chosen on simulated homes.

    Attributes:
        nearest: share of echoes that come from the nearest surface in the beam; the others come from
            the surface on the beam's axis.
        hit, short, long, anything: shares of the four kinds of echo where an obstacle is expected.
        open_hit, open_long: the same where only the border of the unknown is expected: the wall may
            be anywhere behind it.
        sigma, sigma_per_m: standard deviation of an echo: map error, pose error, sonar noise (m).
        long_decay: metres over which echoes from behind the surface become rarer.
        no_echo: share of readings without echo although a surface is within reach.
        no_echo_beyond: the same where nothing is within reach.
        soft_reach: metres around the sonar's maximum range over which reach fades.
        inside: ratio of a reading taken from a place that is no free ground.
    """

    nearest: float = 0.5
    hit: float = 0.60
    short: float = 0.07
    long: float = 0.25
    anything: float = 0.08
    open_hit: float = 0.03
    open_long: float = 0.85
    sigma: float = 0.07
    sigma_per_m: float = 0.02
    long_decay: float = 1.2
    no_echo: float = 0.07
    no_echo_beyond: float = 0.5
    soft_reach: float = 0.3
    inside: float = 0.22


def reading_codes(ranges: FloatArray) -> IntArray:
    """Ranges (...) in metres, NaN = no echo, as reading codes (...)."""
    units = np.clip(np.round(np.nan_to_num(ranges) / RANGE_STEP), 0, NOTHING)
    return np.where(np.isnan(ranges), NO_ECHO, units).astype(np.int64)


def likelihood_table(
    codes: ByteArray, standable: BoolArray, max_range: float, config: SonarLikelihoodConfig
) -> Table:
    """The likelihood ratios of one kind of sonar in one map.

    Args:
        codes: (directions, rows, cols, 2) expected ranges: nearest in the beam, on its axis.
        standable: (rows, cols) the places that count for the average place.
        max_range: of the sonar, metres.
        config: the beam model.
    """
    likelihood = np.stack([_likelihood(code, max_range, config) for code in range(CODES)], axis=1)
    shares = (config.nearest, 1 - config.nearest)
    parts = [share * likelihood for share in shares]
    average = np.zeros(NO_ECHO + 1)
    for surface, part in enumerate(parts):
        seen = np.bincount(codes[:, standable, surface].ravel(), minlength=CODES).astype(float)
        average += part @ (seen / max(seen.sum(), 1.0))
    ratio = np.stack(parts, axis=1) / np.maximum(average, TINY)[:, None, None]
    ratio[average < TINY] = np.array(shares)[:, None]
    ratio[:, :, INSIDE] = config.inside * np.array(shares)
    return np.asarray(ratio, np.float32)


def _likelihood(code: int, max_range: float, config: SonarLikelihoodConfig) -> FloatArray:
    """p(reading | expected range code): (NO_ECHO + 1,), sums to 1."""
    z = np.arange(NO_ECHO) * RANGE_STEP
    measurable = (z <= max_range + RANGE_STEP / 2).astype(float)
    within = code & NOTHING
    d = within * RANGE_STEP if within != NOTHING else math.inf
    reached = float(np.clip((max_range + config.soft_reach - d) / (2 * config.soft_reach), 0, 1))
    silent = config.no_echo + (1 - reached) * config.no_echo_beyond
    hit, long = (config.open_hit, config.open_long) if code >= OPEN else (config.hit, config.long)
    echo = config.anything * _share(measurable) + config.short * _share(measurable * (z < d))
    if math.isfinite(d):
        sigma = config.sigma + config.sigma_per_m * d
        echo = echo + hit * _share(np.exp(-0.5 * ((z - d) / sigma) ** 2)) * measurable
        behind = np.exp(-np.maximum(z - d, 0.0) / config.long_decay) * (z > d)
        echo = echo + long * _share(measurable * behind)
    else:
        echo = echo + (hit + long) * _share(measurable)
    return np.append(_share(echo) * (1 - silent), silent)


def _share(weights: FloatArray) -> FloatArray:
    total = float(weights.sum())
    return weights / total if total > 0 else weights
