"""Bayes over nodes: prior from the motion model, posterior from the match (eq. 16-17)."""

from __future__ import annotations

import numpy as np

from core.geometry import FloatArray


def prior(transition: FloatArray, before: FloatArray) -> FloatArray:
    """P(N_t | u, z_1:t-1) of eq. (17): (n,), normalised.

    Args:
        transition: P(N_t = i | N_t-1 = j) up to a factor, (n, n), `[i, j]`.
        before: P(N_t-1 = j), (n,).
    """
    return _normalised(transition @ before)  # eq. (17)


def posterior(match: FloatArray, before: FloatArray) -> FloatArray:
    """P(N_t | u, z_1:t) of eq. (16): (n,), normalised by eta_1."""
    return _normalised(match * before)  # eq. (16)


def _normalised(weights: FloatArray) -> FloatArray:
    """Weights as probabilities; when all are zero nothing is known."""
    total = float(weights.sum())
    if not np.isfinite(total) or total <= 0:
        return np.full(len(weights), 1 / len(weights))
    return np.asarray(weights / total)
