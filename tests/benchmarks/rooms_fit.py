"""Fits the judges of rooms to maps with ground-truth rooms and cross-validates them over buildings.

    python tests/benchmarks/rooms_fit.py --data SHARED [--shuffles 3] [--homes 40] [--jobs 2] [--write]

Needs scikit-learn. Beside the maps of SHARED/rooms it fits to maps that simulated sonar drives make
of generated homes (random-101 onwards; none that other benchmarks report), and tells what it finds
in ten that it is not fitted to. Every map weighs so that each group of maps counts the same.

The border model learns from the borders that come up while draft cells merge in several orders, in
the last round those that the model itself meets (the imitation learning of Ross et al., 2011). The
room model learns from the regions that come up while draft cells merge by a border model that was
not fitted to their building (stacking, Wolpert, 1992). `--write` fits to all maps and stores both.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
from rooms_maps import GROUPS, MapOfRooms, load_maps, scored
from rooms_samples import Draft, Samples
from sonar_maps import SONAR, sonar_maps

from core.geometry import FloatArray
from core.segmentation import boundary_model, room_model
from core.segmentation.automatic import AutomaticConfig, RoomJudges, segment_rooms
from core.segmentation.boundary_model import BoundaryModel
from core.segmentation.decision_forest import DecisionForest
from core.segmentation.room_model import RoomModel

BORDER_TREES = {"n_estimators": 100, "min_samples_leaf": 12, "max_features": 0.7}
ROOM_TREES = {"n_estimators": 100, "min_samples_leaf": 5, "max_features": 0.5}
HELD_BACK = 10
"""Simulated homes that are not fitted to."""
FOLDS, INNER_FOLDS = 6, 4
"""Parts of the buildings: for the score, and for the trees that the room model learns from."""
SAME_BUILDING = {
    "real:freiburg_building101": "ipa:Freiburg101_scan",
    "real:freiburg_building52": "ipa:Freiburg52_scan",
    "real:NOGT-intel_map": "ipa:lab_intel",
}
"""Buildings that the list of maps calls by two names."""


@dataclass(frozen=True)
class Lesson:
    """A map to learn from."""

    map: MapOfRooms
    draft: Draft
    borders: Samples

    @property
    def building(self) -> str:
        """The building that it shows."""
        return SAME_BUILDING.get(self.map.building, self.map.building)


def lesson_of(entry: MapOfRooms) -> Lesson:
    """The lesson of a map."""
    draft = Draft(entry, AutomaticConfig())
    return Lesson(entry, draft, draft.first_borders())


def forest_of(fitted: Any) -> DecisionForest:
    """The trees of a fitted forest, rounded as they are stored."""
    parts: dict[str, list[float]] = {k: [] for k in ("root", "feature", "threshold", "ahead")}
    for tree in (estimator.tree_ for estimator in fitted.estimators_):
        start, leaf = len(parts["feature"]), tree.children_left < 0
        knot = np.arange(len(leaf))
        assert (tree.children_left[~leaf] == knot[~leaf] + 1).all()
        answer = tree.value[:, 0, :]
        answer = answer[:, 1] / answer.sum(axis=1) if answer.shape[1] == 2 else answer[:, 0]
        parts["root"].append(start)
        parts["feature"] += np.where(leaf, -1, tree.feature).tolist()
        parts["threshold"] += np.where(leaf, answer, tree.threshold).astype(np.float32).tolist()
        parts["ahead"] += np.where(leaf, 0, tree.children_right - knot).tolist()
    whole = {k: np.array(v, float if k == "threshold" else np.int64) for k, v in parts.items()}
    return DecisionForest(**whole)


def fitted(trees: Any, samples: list[Samples], lessons: list[Lesson]) -> DecisionForest:
    """Trees fitted to the samples of each lesson; every group counts the same, and so does every
    map of it."""
    groups = [lesson.map.group for lesson in lessons]
    weight: FloatArray = np.concatenate(
        [s.weight / max(1, len(s.weight)) / groups.count(g)
         for s, g in zip(samples, groups, strict=True)]
    )  # fmt: skip
    x = np.concatenate([s.features for s in samples])
    y = np.concatenate([s.answer for s in samples])
    return forest_of(trees.fit(x, y, weight * len(weight) / weight.sum()))


def border_model(lessons: list[Lesson]) -> BoundaryModel:
    """A model fitted to merging orders, then again with the borders that it meets itself."""
    from sklearn.ensemble import ExtraTreesClassifier

    samples = [lesson.borders for lesson in lessons]
    for _ in range(2):
        forest = fitted(ExtraTreesClassifier(**BORDER_TREES, random_state=0), samples, lessons)
        model = BoundaryModel(forest)
        samples = [lesson.borders + lesson.draft.borders("own", model=model) for lesson in lessons]
    return model


def judges_of(lessons: list[Lesson]) -> RoomJudges:
    """Both models, fitted to these maps alone."""
    from sklearn.ensemble import ExtraTreesRegressor

    fold = drawn_folds(lessons, INNER_FOLDS, seed=0)
    regions: dict[int, Samples] = {}
    for k in range(INNER_FOLDS):
        others = border_model([own for own, f in zip(lessons, fold, strict=True) if f != k])
        for i in (i for i, f in enumerate(fold) if f == k):
            regions[i] = lessons[i].draft.regions(others)
    samples = [regions[i] for i in range(len(lessons))]
    rooms = fitted(ExtraTreesRegressor(**ROOM_TREES, random_state=0), samples, lessons)
    return RoomJudges(border_model(lessons), RoomModel(rooms))


def drawn_folds(lessons: list[Lesson], folds: int, seed: int) -> list[int]:
    """The fold of each map, all maps of a building in one."""
    buildings = sorted({lesson.building for lesson in lessons})
    np.random.default_rng(seed).shuffle(buildings)
    fold = {building: i % folds for i, building in enumerate(buildings)}
    return [fold[lesson.building] for lesson in lessons]


def quality(m: MapOfRooms, judges: RoomJudges) -> float:
    """Panoptic quality on a map."""
    return scored(m, segment_rooms(m.grid, judges=judges))["pq"]


def told(what: str, m: MapOfRooms, pq: float) -> float:
    """The quality, printed."""
    sys.stdout.write(f"{what}  {m.name:34s} pq {pq:.3f}\n")
    sys.stdout.flush()
    return pq


class Validation:
    """Cross-validation: real maps in folds, simulated homes always fitted to."""

    def __init__(
        self, real: list[Lesson], homes: list[Lesson], held_back: list[MapOfRooms]
    ) -> None:
        self._real, self._homes, self._held_back = real, homes, held_back

    def __call__(self, run: tuple[int, int]) -> list[tuple[MapOfRooms, float]]:
        """Quality on the maps of a fold (shuffle, fold), and in the first one on what is held back."""
        shuffle, k = run
        fold = drawn_folds(self._real, FOLDS, shuffle)
        lessons = [own for own, f in zip(self._real, fold, strict=True) if f != k]
        judges = judges_of(lessons + self._homes)
        asked = [own.map for own, f in zip(self._real, fold, strict=True) if f == k]
        return [(m, quality(m, judges)) for m in asked + (self._held_back if k == 0 else [])]


def validate(validation: Validation, shuffles: int, jobs: int) -> None:
    """Prints the quality on every map, and the means of the groups."""
    runs = [(shuffle, k) for shuffle in range(1, shuffles + 1) for k in range(FOLDS)]
    score: dict[tuple[str, int], list[float]] = {}
    with get_context("fork").Pool(jobs, _keep, (validation,)) as pool:
        for (shuffle, k), found in zip(runs, pool.imap(_run, runs), strict=True):
            for m, pq in found:
                score.setdefault((m.group, shuffle), []).append(pq)
                told(f"shuffle {shuffle} fold {k}", m, pq)
    for group in (*GROUPS, SONAR):
        means = np.array([np.mean(score[group, s]) for s in range(1, shuffles + 1)])
        sys.stdout.write(f"{group:16s} pq {means.mean():.3f}  of each shuffle {means.round(3)}\n")


_validation: list[Validation] = []
"""What a worker process validates with: too large to be sent with every run."""


def _keep(validation: Validation) -> None:
    _validation.append(validation)


def _run(run: tuple[int, int]) -> list[tuple[MapOfRooms, float]]:
    return _validation[0](run)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--shuffles", type=int, default=3)
    parser.add_argument("--homes", type=int, default=40)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    simulated = sonar_maps(options.homes + HELD_BACK, options.jobs)
    held_back = simulated[:HELD_BACK]
    real = [lesson_of(m) for m in load_maps(options.data)]
    homes = [lesson_of(m) for m in simulated[HELD_BACK:]]
    sys.stdout.write(f"{len(real)} maps, {len(homes)} simulated homes\n")
    if not options.write:
        validate(Validation(real, homes, held_back), options.shuffles, options.jobs)
        return
    judges = judges_of(real + homes)
    for module, forest in (
        (boundary_model, judges.border.forest),
        (room_model, judges.room.forest),
    ):
        path = Path(module.__file__).with_name(module.STORED)
        forest.write(path)
        sys.stdout.write(f"{len(forest.feature)} knots -> {path.name}\n")
    mean = np.mean([told("held back", m, quality(m, judges)) for m in held_back])
    sys.stdout.write(f"{SONAR:16s} pq {mean:.3f}\n")


if __name__ == "__main__":
    main()
