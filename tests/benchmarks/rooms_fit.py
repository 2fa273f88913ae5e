"""Fits the boundary model to maps with ground-truth rooms and cross-validates it over buildings.

    python tests/benchmarks/rooms_fit.py --data SHARED [--shuffles 3] [--homes 40] [--jobs 2] [--write]

Needs scikit-learn. Beside the maps of SHARED/rooms it fits to maps that simulated sonar drives make
of generated homes (random-101 onwards; none that other benchmarks report), and tells what it finds
in ten that it is not fitted to. Every map weighs so that each group of maps counts the same. A border is real
when most of the floor on both sides belongs to different rooms; samples are the borders that come
up while draft cells merge in several orders, in the last round those that the model itself meets
(the imitation learning of Ross et al., 2011). `--write` fits to all maps and stores the model.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rooms_maps import GROUPS, MapOfRooms, load_maps, scored
from sonar_maps import SONAR, sonar_maps

import core.segmentation.boundary_model as boundary_model
from core.geometry import BoolArray, FloatArray
from core.segmentation.automatic import AutomaticConfig, draft_of, segment_automatically
from core.segmentation.boundary_features import FEATURES
from core.segmentation.boundary_model import BoundaryModel
from core.segmentation.merging import RegionGraph, merge

TREES = {"max_leaf_nodes": 6, "max_iter": 80, "min_samples_leaf": 40, "learning_rate": 0.1,
         "l2_regularization": 1.0, "max_features": 0.3}  # fmt: skip
ENSEMBLES = 4
"""Sets of trees, each seeing other features at its splits; what they say is averaged."""
NEVER = 1e3
MET = -0.4
"""Log-odds up to which a model merges while it meets borders to learn from."""
FEWEST = 20
HELD_BACK = 10
FOLDS = 6
SAME_BUILDING = {
    "real:freiburg_building101": "ipa:Freiburg101_scan",
    "real:freiburg_building52": "ipa:Freiburg52_scan",
    "real:NOGT-intel_map": "ipa:lab_intel",
}
"""Buildings that the list of maps calls by two names."""
"""Simulated homes that are not fitted to."""


@dataclass(frozen=True)
class Samples:
    """Features (n, f), whether the border is real (n,), weight (n,)."""

    features: FloatArray
    real: BoolArray
    weight: FloatArray

    def __add__(self, other: Samples) -> Samples:
        return Samples(
            np.concatenate((self.features, other.features)),
            np.concatenate((self.real, other.real)),
            np.concatenate((self.weight, other.weight)),
        )


class Draft:
    """Draft cells of a map and how much of each true room they hold."""

    def __init__(self, entry: MapOfRooms, config: AutomaticConfig) -> None:
        grid = entry.grid
        self.cells, self.around = draft_of(
            grid.free, grid.occupied, grid.geometry.resolution, config.draft, config.clutter
        )
        known = (entry.truth > 0) & grid.free & (self.cells > 0)
        self.held = np.zeros((int(self.cells.max()) + 1, int(entry.truth.max()) + 1))
        np.add.at(self.held, (self.cells[known], entry.truth[known]), 1)

    def samples(self, order: str, seed: int = 0, model: BoundaryModel | None = None) -> Samples:
        """Borders met while merging in an order: first, random, open or the model's own."""
        rng = np.random.default_rng(seed)
        held = self.held.copy()
        met: dict[tuple[int, int], tuple[FloatArray, bool, float]] = {}

        def judge(pairs: list[tuple[int, int]], features: FloatArray) -> FloatArray:
            own = model.log_odds(features) if model else np.full(len(pairs), NEVER)
            for k, (a, b) in enumerate(pairs):
                if min(held[a].sum(), held[b].sum()) < FEWEST:
                    continue
                share_a, share_b = held[a] / held[a].sum(), held[b] / held[b].sum()
                real = bool(share_a.argmax() != share_b.argmax())
                met[a, b] = (features[k], real, float(min(share_a.max(), share_b.max())) ** 3)
                if not model and order != "first" and not real:
                    own[k] = rng.random() if order == "random" else -features[k][6]
            return own

        def merged(kept: int, gone: int) -> None:
            held[kept] += held[gone]
            if not model:
                for pair in [p for p in met if gone in p and met[p][1]]:
                    del met[pair]

        limit = MET if model else NEVER / 2
        merge(RegionGraph(self.cells, self.around), judge, limit, merged)
        rows = list(met.values())
        if not rows:
            return Samples(np.zeros((0, len(FEATURES))), np.zeros(0, bool), np.zeros(0))
        return Samples(
            np.array([r[0] for r in rows]),
            np.array([r[1] for r in rows]),
            np.array([r[2] for r in rows]),
        )


def fit(samples: list[Samples], groups: list[str]) -> BoundaryModel:
    """Trees that tell real borders from others."""
    from sklearn.ensemble import HistGradientBoostingClassifier

    share = {group: 1 / groups.count(group) for group in set(groups)}
    weight = np.concatenate(
        [s.weight / max(1, len(s.weight)) * share[g] for s, g in zip(samples, groups, strict=True)]
    )
    x = np.concatenate([s.features for s in samples])
    y = np.concatenate([s.real for s in samples])
    weight *= len(weight) / weight.sum()
    return as_model(
        [
            HistGradientBoostingClassifier(**TREES, random_state=seed).fit(x, y, weight)
            for seed in range(ENSEMBLES)
        ]
    )


def as_model(ensembles: list[Any]) -> BoundaryModel:
    """The splits of fitted trees, as one set of trees that gives the mean."""
    parts: dict[str, list[float]] = {k: [] for k in ("root", "f", "t", "low", "high", "v")}
    for predictor in (p for trees in ensembles for p in trees._predictors):
        knots, start = predictor[0].nodes, len(parts["f"])
        parts["root"].append(start)
        leaf = knots["is_leaf"].astype(bool)
        parts["f"] += np.where(leaf, -1, knots["feature_idx"].astype(int)).tolist()
        parts["t"] += knots["num_threshold"].tolist()
        parts["low"] += (knots["left"].astype(int) + start).tolist()
        parts["high"] += (knots["right"].astype(int) + start).tolist()
        parts["v"] += np.where(leaf, knots["value"] / len(ensembles), 0.0).tolist()
    whole = {k: np.array(parts[k], np.int64) for k in ("root", "f", "low", "high")}
    base = float(np.mean([np.ravel(trees._baseline_prediction)[0] for trees in ensembles]))
    exact = BoundaryModel(
        whole["root"], whole["f"], np.array(parts["t"]), whole["low"], whole["high"],
        np.array(parts["v"]), base,
    )  # fmt: skip
    return BoundaryModel.from_dict(exact.as_dict())


def trained(
    drafts: list[Draft], base: list[Samples], groups: list[str], rounds: int
) -> BoundaryModel:
    """A model fitted to merging orders, then again with the borders that it meets itself."""
    samples = list(base)
    model = fit(samples, groups)
    for _ in range(rounds):
        samples = [s + d.samples("own", model=model) for s, d in zip(samples, drafts, strict=True)]
        model = fit(samples, groups)
    return model


def samples_of(draft: Draft) -> Samples:
    """Borders met in the orders that know no model."""
    random = draft.samples("random", 1) + draft.samples("random", 2)
    return draft.samples("first") + random + draft.samples("open")


def drawn_folds(maps: list[MapOfRooms], seed: int) -> list[int]:
    """The fold of each map, all maps of a building in one; the simulated homes are in none."""
    names = [SAME_BUILDING.get(m.building, m.building) for m in maps]
    buildings = sorted({n for n, m in zip(names, maps, strict=True) if m.group != SONAR})
    np.random.default_rng(seed).shuffle(buildings)
    fold = {building: i % FOLDS for i, building in enumerate(buildings)}
    return [fold.get(name, -1) for name in names]


def told(m: MapOfRooms, model: BoundaryModel, what: str) -> float:
    """Panoptic quality on a map, printed."""
    quality = scored(m, segment_automatically(m.grid, model=model).rooms)["pq"]
    sys.stdout.write(f"{what}  {m.name:34s} pq {quality:.3f}\n")
    sys.stdout.flush()
    return quality


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--shuffles", type=int, default=3)
    parser.add_argument("--homes", type=int, default=40)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    homes = sonar_maps(options.homes + HELD_BACK, options.jobs)
    maps, held_back = load_maps(options.data) + homes[HELD_BACK:], homes[:HELD_BACK]
    drafts = [Draft(m, AutomaticConfig()) for m in maps]
    base = [samples_of(draft) for draft in drafts]
    sys.stdout.write(f"{sum(len(s.real) for s in base)} samples of {len(maps)} maps\n")

    def trained_on(chosen: list[int]) -> BoundaryModel:
        return trained(
            [drafts[i] for i in chosen], [base[i] for i in chosen],
            [maps[i].group for i in chosen], options.rounds,
        )  # fmt: skip

    score: dict[str, list[float]] = {group: [] for group in (*GROUPS, SONAR)}
    if options.write:
        model = trained_on(list(range(len(maps))))
        path = Path(boundary_model.__file__).with_name(boundary_model.STORED)
        path.write_text(json.dumps(model.as_dict()) + "\n", encoding="utf-8")
        sys.stdout.write(f"{len(model.root)} trees -> {path.name}\n")
        score = {SONAR: [told(m, model, "held back") for m in held_back]}
    else:
        for seed in range(1, options.shuffles + 1):
            fold = drawn_folds(maps, seed)
            for k in range(FOLDS):
                model = trained_on([i for i in range(len(maps)) if fold[i] != k])
                for m in (m for m, own in zip(maps, fold, strict=True) if own == k):
                    score[m.group].append(told(m, model, f"shuffle {seed} fold {k}"))
            score[SONAR] += [told(m, model, f"shuffle {seed} held back") for m in held_back]
    for group, mine in score.items():
        runs = np.reshape(mine, (1 if options.write else options.shuffles, -1)).mean(axis=1)
        sys.stdout.write(f"{group:16s} pq {runs.mean():.3f}  of each shuffle {runs.round(3)}\n")


if __name__ == "__main__":
    main()
