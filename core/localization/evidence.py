"""From scores to evidence: how much a better fit is worth.

Scores of places differ for two reasons: one is wrong, or the map is a little worse there (drift,
furniture half seen). A small difference therefore says little and a large one much: the gap x
between the best score and that of a place counts as g(x) = x^3 / (x^2 + k^2), which is small below
k and x above. Around a place, where the map's errors are shared, differences count in full, so that
the position stays sharp.
"""

from __future__ import annotations

from dataclasses import dataclass

import numba
import numpy as np
from scipy import ndimage

from core.geometry import IntArray
from core.localization.pose_grid import MassArray
from core.localization.pose_observation import BLOCK, TURN, Blocks, ScoreArray

NEIGHBOURHOOD = 3
"""Blocks in a row, and in heading, that share one place."""


@dataclass(frozen=True)
class EvidenceConfig:
    """How scores count. Chosen on simulated homes for calibrated probabilities.

    Attributes:
        temper: exponent of the likelihood. Readings a few centimetres apart see the same surface and
            the same error of the map, so they count for far less than as many independent ones.
        indifference: k as a share of the best possible score.
    """

    temper: float = 0.2
    indifference: float = 0.1


def discounted(gap: float, scale: float) -> float:
    """g(x) = x^3 / (x^2 + k^2) for a gap x >= 0 and k > 0."""
    return gap**3 / (gap**2 + scale**2)


def evidence_of(
    score: ScoreArray,
    blocks: Blocks,
    outside: float,
    best_possible: float,
    config: EvidenceConfig,
) -> tuple[ScoreArray, float]:
    """Log-evidence of every pose (headings, rows, cols) and of `unknown`; the best is about 0.

    Args:
        score: log-likelihood ratio of every pose, -inf where nobody can stand; it is overwritten.
        blocks: the places in blocks.
        outside: score that a place outside the map is credited with.
        best_possible: score of a place where every reading is what it should be.
        config: how scores count.
    """
    peaks = _block_peaks(score, blocks.corners)
    best = max(float(peaks.max()), outside) if peaks.size else outside
    scale = max(config.indifference * best_possible, 1e-6)
    gap = np.maximum(best - _shared(peaks, blocks.corners, score.shape), 0)
    worth = gap**3 / (gap**2 + scale**2)
    worth = (worth - gap).astype(np.float32)
    _apply(score, blocks.corners, worth, best, config.temper)
    return score, -config.temper * discounted(best - outside, scale)


def _shared(peaks: ScoreArray, corners: IntArray, shape: tuple[int, ...]) -> ScoreArray:
    """The highest peak among neighbouring blocks: (groups, blocks)."""
    rows, cols = corners.T // BLOCK
    dense = np.full(
        (peaks.shape[0], -(-shape[1] // BLOCK), -(-shape[2] // BLOCK)), -np.inf, np.float32
    )
    dense[:, rows, cols] = peaks
    highest = ndimage.maximum_filter(dense, NEIGHBOURHOOD, mode=("wrap", "nearest", "nearest"))
    return np.asarray(highest[:, rows, cols])


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _block_peaks(score: ScoreArray, corners: IntArray) -> ScoreArray:
    headings, rows, cols = score.shape
    out = np.full((-(-headings // TURN), len(corners)), np.float32(-np.inf))
    for h in range(headings):
        for b in range(len(corners)):
            row, col = corners[b]
            for r in range(row, min(row + BLOCK, rows)):
                for c in range(col, min(col + BLOCK, cols)):
                    out[h // TURN, b] = max(out[h // TURN, b], score[h, r, c])
    return out


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _apply(
    score: ScoreArray, corners: IntArray, worth: MassArray, best: float, temper: float
) -> None:
    """score -> -temper * (best - score + worth of the block)."""
    headings, rows, cols = score.shape
    for h in range(headings):
        for b in range(len(corners)):
            row, col = corners[b]
            for r in range(row, min(row + BLOCK, rows)):
                for c in range(col, min(col + BLOCK, cols)):
                    score[h, r, c] = -temper * (best - score[h, r, c] + worth[h // TURN, b])
