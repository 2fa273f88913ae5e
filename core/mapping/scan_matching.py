"""Correlative matching of one local sonar map with another.

Two submaps are compared by the sum over the points of one of the density of the other, for all poses
on a lattice (Olson 2009: correlative scan matching).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np

from core.geometry import FloatArray
from core.mapping.matching_config import MatchingConfig
from core.mapping.submap import Float32Array, Submap


@dataclass(frozen=True)
class Match:
    """The best pose of one submap in the frame of another.

    Attributes:
        pose: (3,) of the one in the frame of the other.
        score: mean agreement per point, at most 1.
        ambiguity: score of the best pose elsewhere over that of this one.
        at_edge: the best pose lies at the border of the search: the true one may lie outside.
        covariance: (3, 3) of the pose: wide where the match slides (along a corridor).
    """

    pose: FloatArray
    score: float
    ambiguity: float
    at_edge: bool
    covariance: FloatArray


def match(
    query: Submap,
    reference: Submap,
    guess: FloatArray,
    reach: float,
    turn_reach: float,
    config: MatchingConfig | None = None,
) -> Match | None:
    """The best pose of `query` in the frame of `reference` near `guess`; None without points.

    Args:
        query: whose points are compared.
        reference: whose density they are compared with.
        guess: (3,) middle of the search.
        reach: how far to search in x and y (m).
        turn_reach: how far to search in heading (rad).
        config: parameters.
    """
    config = config or MatchingConfig()
    if query.weight <= 0 or len(reference.points) == 0:
        return None
    steps = max(1, math.ceil(reach / config.cell))
    turns = max(1, math.ceil(turn_reach / config.turn_step))
    headings = guess[2] + config.turn_step * np.arange(-turns, turns + 1)
    scores = _correlate(
        reference.density, reference.corner, config.cell, query.points, query.views,
        np.hypot(query.views[:, 0], query.views[:, 1]), guess, headings, steps,
    )  # fmt: skip
    scores /= query.weight
    return _best(scores, guess, headings, steps, config)


def _best(
    scores: Float32Array,
    guess: FloatArray,
    headings: FloatArray,
    steps: int,
    config: MatchingConfig,
) -> Match:
    """The peak of the score volume (headings, x, y), refined by a parabola along each axis."""
    peak = tuple(int(p) for p in np.unravel_index(int(scores.argmax()), scores.shape))
    best = float(scores[peak])
    shift = [_parabola_top(scores, peak, axis) for axis in range(3)]
    pose = np.array(
        [
            guess[0] + (peak[1] - steps + shift[1]) * config.cell,
            guess[1] + (peak[2] - steps + shift[2]) * config.cell,
            headings[peak[0]] + shift[0] * config.turn_step,
        ]
    )
    at_edge = any(p in (0, n - 1) for p, n in zip(peak, scores.shape, strict=True))
    covariance = _covariance(scores, peak, best, config)
    around = tuple(
        slice(max(0, p - config.peak_exclusion), p + config.peak_exclusion + 1) for p in peak
    )
    scores[around] = 0.0
    second = float(scores.max())
    return Match(pose, best, second / best if best > 0 else 1.0, at_edge, covariance)


def _parabola_top(scores: Float32Array, peak: tuple[int, ...], axis: int) -> float:
    """How far off the lattice (in steps) the top lies along an axis."""
    if not 0 < peak[axis] < scores.shape[axis] - 1:
        return 0.0
    low, high = (
        float(scores[tuple(p + side * (k == axis) for k, p in enumerate(peak))]) for side in (-1, 1)
    )
    bend = low - 2 * float(scores[peak]) + high
    return 0.5 * (low - high) / bend if bend < 0 else 0.0


def _covariance(
    scores: Float32Array, peak: tuple[int, ...], best: float, config: MatchingConfig
) -> FloatArray:
    """Spread (3, 3) in x, y, heading of the poses that score nearly as well (Olson 2009)."""
    likely = np.exp(config.sharpness * (scores - best))
    turn, x, y = np.nonzero(likely > config.likely)
    weight = likely[turn, x, y]
    offset = np.stack(
        (
            (x - peak[1]) * config.cell,
            (y - peak[2]) * config.cell,
            (turn - peak[0]) * config.turn_step,
        ),
        axis=1,
    )
    spread = np.asarray((offset * weight[:, None]).T @ offset / weight.sum())
    floor = np.array([config.position_floor, config.position_floor, config.heading_floor])
    return spread + np.diag(floor**2)


@numba.njit(cache=True)
def _correlate(density, corner, cell, points, views, weights, guess, headings, steps):  # type: ignore[no-untyped-def]
    """Scores (headings, 2 steps + 1, 2 steps + 1) of all poses of the lattice around the guess."""
    side = 2 * steps + 1
    scores = np.zeros((len(headings), side, side), np.float32)
    rows, cols = density.shape[0], density.shape[1]
    for a in range(len(headings)):
        c, s = math.cos(headings[a]), math.sin(headings[a])
        for k in range(len(points)):
            x = guess[0] + c * points[k, 0] - s * points[k, 1] - corner[0]
            y = guess[1] + s * points[k, 0] + c * points[k, 1] - corner[1]
            vx = np.float32(c * views[k, 0] - s * views[k, 1])
            vy = np.float32(s * views[k, 0] + c * views[k, 1])
            w = np.float32(weights[k])
            u = int(math.floor(x / cell)) - steps
            v = int(math.floor(y / cell)) - steps
            low_j, high_j = max(0, -v), min(side, cols - v)
            for i in range(max(0, -u), min(side, rows - u)):
                for j in range(low_j, high_j):
                    here = density[u + i, v + j]
                    scores[a, i, j] += vx * here[0] + vy * here[1] + w * here[2]
    return scores
