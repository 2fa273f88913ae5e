"""The matching probability of each node's candidate (eq. 14-15)."""

from __future__ import annotations

import numpy as np

from core.geometry import FloatArray

CLOSEST = 1e-6
"""Dissimilarity taken for zero: identical vectors would divide by it."""


def distance_similarity(dissimilarities: FloatArray) -> FloatArray:
    """P_D of eq. (14): (k,) from Delta D_i (k,); sums to 1. Infinite = a node without candidate."""
    inverse = 1 / np.maximum(dissimilarities, CLOSEST)
    total = float(inverse.sum())
    return np.asarray(inverse / total if total > 0 else np.full(len(inverse), 1 / len(inverse)))


def matching_probability(similarities: FloatArray, correlations: FloatArray) -> FloatArray:
    """P_match of eq. (15): (k,). Not normalised; a negative correlation counts as none."""
    return np.asarray(similarities * np.maximum(correlations, 0.0))  # eq. (15)
