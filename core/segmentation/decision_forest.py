"""A forest of decision trees that was fitted elsewhere and is only asked here."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import as_file, files
from pathlib import Path

import numba
import numpy as np

from core.geometry import AnyArray, FloatArray


@dataclass(frozen=True)
class DecisionForest:
    """Trees in one table of knots; at a split, the knot after it is where small values go on.

    The numbers may be small ones (int8, float32): asking a large forest is waiting for memory.

    Attributes:
        root: (t,) knot at which each tree begins.
        feature: (k,) feature that a knot asks for, -1 at a leaf.
        threshold: (k,) up to which one goes on to the next knot; the answer at a leaf.
        ahead: (k,) by how many knots one goes on beyond it.
    """

    root: AnyArray
    feature: AnyArray
    threshold: AnyArray
    ahead: AnyArray

    def mean(self, features: FloatArray) -> FloatArray:
        """The trees' mean answer (n,) to features (n, f)."""
        asked = np.ascontiguousarray(features, float)
        return np.asarray(_mean(asked, self.root, self.feature, self.threshold, self.ahead))

    def write(self, path: Path) -> None:
        """Stores the forest in a file of a few bytes a knot."""
        np.savez_compressed(
            path,
            root=self.root.astype(np.int32),
            feature=self.feature.astype(np.int8),
            threshold=self.threshold.astype(np.float32),
            ahead=self.ahead.astype(np.int32),
        )


@cache
def stored_forest(name: str) -> DecisionForest:
    """A forest that comes with the program, by the name of its file."""
    with (
        as_file(files("core.segmentation").joinpath(name)) as path,
        np.load(path, allow_pickle=False) as stored,
    ):
        return DecisionForest(*(stored[name] for name in ("root", "feature", "threshold", "ahead")))


@numba.njit(cache=True)
def _mean(
    features: FloatArray, root: AnyArray, feature: AnyArray, threshold: AnyArray, ahead: AnyArray
) -> FloatArray:
    out = np.zeros(len(features))
    for first in root:  # all rows through one tree while it is in the cache
        for i in range(len(features)):
            knot = first
            while feature[knot] >= 0:
                low = features[i, feature[knot]] <= threshold[knot]
                knot += 1 if low else ahead[knot]
            out[i] += threshold[knot]
    return out / len(root)
