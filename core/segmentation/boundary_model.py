"""How likely a border between two regions is the border of two rooms.

Extremely randomized trees (Geurts et al., 2006) over the features of `boundary_features.py`, fitted
by `tests/benchmarks/rooms_fit.py` to maps with ground-truth rooms.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray
from core.segmentation.decision_forest import DecisionForest, stored_forest

STORED = "boundary_model.npz"
SURE = 0.005
"""The trees are never surer than this, whatever they say: probabilities stay off 0 and 1."""


@dataclass(frozen=True)
class BoundaryModel:
    """The trees; their mean answer is a probability."""

    forest: DecisionForest

    def log_odds(self, features: FloatArray) -> FloatArray:
        """Log-odds (n,) that borders with these features (n, f) part two rooms."""
        real = np.clip(self.forest.mean(features), SURE, 1 - SURE)
        return np.asarray(np.log(real / (1 - real)))


def stored_boundary_model() -> BoundaryModel:
    """The model that the program uses."""
    return BoundaryModel(stored_forest(STORED))
