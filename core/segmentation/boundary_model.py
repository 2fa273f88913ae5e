"""How likely a border between two regions is the border of two rooms: boosted trees.

Fitted by `tests/benchmarks/rooms_fit.py` to maps with ground-truth rooms; what is stored beside this
file are the splits of the trees (Friedman, 2001) over the features of `boundary_features.py`.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numba
import numpy as np

from core.geometry import FloatArray, IntArray
from core.segmentation.boundary_features import FEATURES

STORED = "boundary_model.json"


@dataclass(frozen=True)
class BoundaryModel:
    """Trees in one table of knots.

    Attributes:
        root: (t,) knot at which each tree begins.
        feature: (k,) feature that a knot asks for, -1 at a leaf.
        threshold: (k,) up to which one goes on to `low`, beyond to `high`.
        low, high: (k,) next knot.
        value: (k,) what a leaf adds to the log-odds.
        base: log-odds before any tree.
    """

    root: IntArray
    feature: IntArray
    threshold: FloatArray
    low: IntArray
    high: IntArray
    value: FloatArray
    base: float

    def log_odds(self, features: FloatArray) -> FloatArray:
        """Log-odds (n,) that borders with these features (n, f) part two rooms."""
        return np.asarray(
            _log_odds(
                np.ascontiguousarray(features, float),
                self.root,
                self.feature,
                self.threshold,
                self.low,
                self.high,
                self.value,
                self.base,
            )
        )

    def as_dict(self) -> dict[str, object]:
        """The trees as JSON can hold them."""
        leaf = self.feature < 0
        return {
            "features": list(FEATURES),
            "base": round(self.base, 5),
            "root": self.root.tolist(),
            "feature": self.feature.tolist(),
            "low": self.low.tolist(),
            "high": self.high.tolist(),
            "number": [
                round(float(v if at_leaf else t), 4)
                for v, t, at_leaf in zip(self.value, self.threshold, leaf, strict=True)
            ],
        }

    @classmethod
    def from_dict(cls, stored: dict[str, object]) -> BoundaryModel:
        """What `as_dict` gave."""
        number = np.array(stored["number"], float)
        feature = np.array(stored["feature"], np.int64)
        low, high = (np.array(stored[key], np.int64) for key in ("low", "high"))
        root = np.array(stored["root"], np.int64)
        base = float(str(stored["base"]))
        return cls(root, feature, number, low, high, np.where(feature < 0, number, 0.0), base)


@cache
def stored_boundary_model() -> BoundaryModel:
    """The model that the program uses."""
    text = files("core.segmentation").joinpath(STORED).read_text(encoding="utf-8")
    return BoundaryModel.from_dict(json.loads(text))


@numba.njit(cache=True)
def _log_odds(features, root, feature, threshold, low, high, value, base):  # type: ignore[no-untyped-def]
    out = np.full(len(features), base)
    for i in range(len(features)):
        for knot in root:
            while feature[knot] >= 0:
                go_low = features[i, feature[knot]] <= threshold[knot]
                knot = low[knot] if go_low else high[knot]
            out[i] += value[knot]
    return out
