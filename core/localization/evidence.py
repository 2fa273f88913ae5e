"""From scores to evidence: how much a better fit is worth.

Places whose scores differ are told apart for two reasons: one of them is wrong, or the map is a
little worse there (drift, furniture half seen). In a home of rooms that are copies of each other the
second reason alone makes differences of up to a sixth of the best possible score, step after step;
added up they would make the robot sure of any of the copies. So the evidence between two places
apart is `discounted`: a gap below k counts for next to nothing, one above it nearly in full.

Around a place, where the map's errors are shared, differences count in full, so that the position
stays sharp. What a whole place gains or loses is counted once, as the mean likelihood of its poses
under the prior: a copy whose map is a little off loses nothing by that either.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np
from scipy import ndimage

from core.geometry import FloatArray, IntArray
from core.localization.pose_grid import MassArray, PoseBelief
from core.localization.pose_observation import BLOCK, TURN, Blocks, ScoreArray

NEIGHBOURHOOD = 3
"""Blocks in a row, and in heading, that share one place."""
LEAST = 1e-300
"""Mass that stands for none in a logarithm."""


@dataclass(frozen=True)
class EvidenceConfig:
    """How scores count. Chosen on simulated homes, mirrored ones among them.

    Attributes:
        temper: exponent of the likelihood. Readings a few centimetres apart see the same surface and
            the same error of the map, so they count for far less than as many independent ones.
        indifference: k as a share of the best possible score. In mirrored homes the scores of the
            copies differ by .04-.07 of it (standard deviation), at most by .2.
        steepness: how fast a gap around k comes to count.
    """

    temper: float = 0.2
    indifference: float = 0.18
    steepness: int = 4


def discounted(gap: FloatArray, scale: float, steepness: int) -> FloatArray:
    """g(x) = x |x|^n / (|x|^n + k^n) for gaps x (...), k = scale > 0 and n = steepness."""
    with np.errstate(over="ignore", divide="ignore"):
        return np.asarray(gap / (1 + (scale / np.abs(gap)) ** steepness))


def updated(
    prior: PoseBelief,
    score: ScoreArray,
    blocks: Blocks,
    outside: float,
    best_possible: float,
    config: EvidenceConfig,
) -> PoseBelief:
    """The belief after the readings of a step (eq. 16 over poses).

    Args:
        prior: the belief before them.
        score: log-likelihood ratio of every pose (headings, rows, cols), -inf where nobody can
            stand.
        blocks: the places in blocks.
        outside: score that a place outside the map is credited with.
        best_possible: score of a place where every reading is what it should be.
        config: how scores count.
    """
    corners, temper = blocks.corners, config.temper
    best = max(float(score.max(initial=-np.inf)), outside)
    mass, fitting = (
        np.maximum(_around(each, corners, score.shape), LEAST)
        for each in _block_sums(prior.mass, score, corners, best, temper)
    )
    level, unknown_level = np.log(fitting / mass), temper * (outside - best)
    unknown_fitting = prior.unknown * math.exp(unknown_level)
    likeliest = level.flat[fitting.argmax()] if fitting.size else -np.inf
    reference = likeliest if fitting.max(initial=0.0) > unknown_fitting else unknown_level
    scale = max(temper * config.indifference * best_possible, LEAST)
    worth = discounted(level - reference, scale, config.steepness)
    posterior = _weighed(prior.mass, score, corners, worth - level, best, temper)
    unknown_worth = discounted(np.array(unknown_level - reference), scale, config.steepness)
    unknown = prior.unknown * math.exp(float(unknown_worth))
    total = float(posterior.sum(dtype=np.float64)) + unknown
    if not total > 0 or not math.isfinite(total):
        return prior
    return PoseBelief((posterior / total).astype(np.float32), unknown / total)


def _around(sums: FloatArray, corners: IntArray, shape: tuple[int, ...]) -> FloatArray:
    """The sums (groups, blocks) of blocks and their neighbours."""
    rows, cols = corners.T // BLOCK
    dense = np.zeros((sums.shape[0], -(-shape[1] // BLOCK), -(-shape[2] // BLOCK)))
    dense[:, rows, cols] = sums
    for axis, mode in enumerate(("wrap", "constant", "constant")):
        dense = ndimage.convolve1d(dense, np.ones(NEIGHBOURHOOD), axis=axis, mode=mode)
    return np.asarray(dense[:, rows, cols])


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _block_sums(
    prior: MassArray, score: ScoreArray, corners: IntArray, best: float, temper: float
) -> tuple[FloatArray, FloatArray]:
    """Of every block (groups, blocks): prior mass, and prior mass times likelihood."""
    headings, rows, cols = score.shape
    mass = np.zeros((-(-headings // TURN), len(corners)))
    fitting = np.zeros(mass.shape)
    for h in range(headings):
        for b in range(len(corners)):
            row, col = corners[b]
            for r in range(row, min(row + BLOCK, rows)):
                for c in range(col, min(col + BLOCK, cols)):
                    mass[h // TURN, b] += prior[h, r, c]
                    fitting[h // TURN, b] += prior[h, r, c] * math.exp(
                        temper * (score[h, r, c] - best)
                    )
    return mass, fitting


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _weighed(
    prior: MassArray,
    score: ScoreArray,
    corners: IntArray,
    extra: FloatArray,
    best: float,
    temper: float,
) -> MassArray:
    """Prior times likelihood times exp(extra of the block); 0 outside all blocks."""
    headings, rows, cols = score.shape
    out = np.zeros_like(prior)
    for h in range(headings):
        for b in range(len(corners)):
            row, col = corners[b]
            for r in range(row, min(row + BLOCK, rows)):
                for c in range(col, min(col + BLOCK, cols)):
                    log = temper * (score[h, r, c] - best) + extra[h // TURN, b]
                    out[h, r, c] = prior[h, r, c] * math.exp(log)
    return out
