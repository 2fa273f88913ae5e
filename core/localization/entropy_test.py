"""The entropy test: a local map that makes the belief less certain is not used yet (eq. 21)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray


@dataclass(frozen=True)
class EntropyTestConfig:
    """The paper tests only while "the maximum node probability was less than some threshold value"
    (4.3.4) and does not say which; this one is ours."""

    sure: float = 0.9


def entropy_of(probabilities: FloatArray) -> float:
    """H(P) of eq. (21): entropy to the base n of n probabilities (n,); 0 = certain, 1 = no idea.

    Zero probabilities count nothing; a single node is always certain.
    """
    p = np.asarray(probabilities, float)
    n = len(p)
    if n < 2:
        return 0.0
    p = p[p > 0]
    return float(np.clip(-(p * np.log(p)).sum() / math.log(n), 0.0, 1.0))  # eq. (21)


def is_accepted(before: FloatArray, after: FloatArray, config: EntropyTestConfig) -> bool:
    """Whether a belief (n,) may take the place of the one before it (n,)."""
    if float(before.max()) >= config.sure:
        return True
    return entropy_of(after) <= entropy_of(before)
