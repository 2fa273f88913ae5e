"""Figures of merit over random homes: mean, spread and worst case, which the paper does not have."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from app.reproduction.extent import Extent
from app.reproduction.localized_drive import localized_drive
from app.reproduction.paper_home_models import corrected
from app.reproduction.simulated_truth import ground_truth, judged
from core.evaluation.localization import LocalizationScore, StepOutcome, summary
from core.pipeline.modeller import ModellingOptions, model_log
from core.progress import Progress, part_of
from core.simulation import simulate

KINDS = {"static": False, "changed": True}
"""Kinds of localization drives, and whether the home has changed."""
DRIVES_PER_HOME = 10
"""Seeds set apart for each home."""
MAP_FIGURES = ("precision_2", "recall_2", "free_iou", "leak_m2", "doors_blocked", "leaks")
REGION_FIGURES = (
    "count",
    "coverage",
    "purity",
    "ari",
    "merged_iou_mean",
    "hidden_mean",
    "hidden_max",
)
LOCALIZATION_FIGURES = (
    "accuracy", "late", "converged", "false_certain", "calibration_error", "position_error",
)  # fmt: skip
LOWER_IS_BETTER = frozenset(
    {
        "leak_m2",
        "doors_blocked",
        "leaks",
        "hidden_mean",
        "hidden_max",
        "false_certain",
        "calibration_error",
        "position_error",
    }
)
NEITHER_IS_BETTER = frozenset({"count"})


@dataclass(frozen=True)
class HomeFigures:
    """One home: its number of rooms and figures by group ("map", "regions", "static, paper", ...)."""

    name: str
    rooms: int
    nodes: int
    groups: Mapping[str, Mapping[str, float]]
    drives: Mapping[str, tuple[StepOutcome, ...]]


@dataclass(frozen=True)
class Spread:
    """A figure over homes; spread is the standard deviation, worst is None where none is better."""

    mean: float
    spread: float
    worst: float | None
    homes: int


def figures_of_home(name: str, extent: Extent, progress: Progress) -> HomeFigures:
    """Maps, models and localizes in one random home."""
    number = int(name.rpartition("-")[2])
    seed = extent.seed + number
    log = simulate(name, seed=seed, tour="mapping", progress=part_of(progress, 0.0, 0.1))
    drive = corrected(log, extent, part_of(progress, 0.1, 0.3))
    options = ModellingOptions(
        "offline" if extent.quick else "autonomous", odometry="raw", seed=extent.seed
    )
    model = model_log(drive.without_truth(), options, part_of(progress, 0.3, 0.7))
    truth = ground_truth(name, drive)
    quality, regions = judged(model, drive, truth)
    groups = {
        "map": {key: float(getattr(quality, key)) for key in MAP_FIGURES},
        "regions": {key: float(getattr(regions, key)) for key in REGION_FIGURES},
    }
    drives: dict[str, tuple[StepOutcome, ...]] = {}
    for i, (kind, changed) in enumerate(KINDS.items()):
        rest = part_of(progress, 0.7 + 0.15 * i, 0.85 + 0.15 * i)
        seed_of_drive = extent.seed + DRIVES_PER_HOME * number + i
        found = localized_drive(name, model, drive, seed_of_drive, changed, extent, rest)
        for method in extent.methods:
            key = f"{kind}, {method}"
            groups[key] = localization_figures(found.score(method))
            drives[key] = found.judged[method]
    return HomeFigures(name, len(truth.names), len(model.topology.nodes), groups, drives)


def localization_figures(score: LocalizationScore) -> dict[str, float]:
    """The figures of one localization score that the table shows."""
    return {key: float(getattr(score, key)) for key in LOCALIZATION_FIGURES}


def many_homes(extent: Extent, progress: Progress) -> tuple[HomeFigures, ...]:
    """The figures of all random homes of an extent."""
    found = []
    for i, name in enumerate(extent.home_names):
        part = part_of(progress, i / extent.homes, (i + 1) / extent.homes)
        found.append(figures_of_home(name, extent, part))
    return tuple(found)


def spreads(homes: tuple[HomeFigures, ...]) -> dict[str, dict[str, Spread]]:
    """Mean, spread and worst case by group and figure."""
    groups = homes[0].groups if homes else {}
    return {
        group: {key: spread_of(key, [home.groups[group][key] for home in homes]) for key in figures}
        for group, figures in groups.items()
    }


def spread_of(key: str, values: list[float]) -> Spread:
    """Mean, standard deviation and worst of the finite values of a figure."""
    finite = np.array([v for v in values if np.isfinite(v)])
    if len(finite) == 0:
        return Spread(float("nan"), float("nan"), None, 0)
    worst = None
    if key not in NEITHER_IS_BETTER:
        worst = float(finite.max() if key in LOWER_IS_BETTER else finite.min())
    deviation = float(finite.std(ddof=1)) if len(finite) > 1 else 0.0
    return Spread(float(finite.mean()), deviation, worst, len(finite))


def together(homes: tuple[HomeFigures, ...]) -> dict[str, LocalizationScore]:
    """The steps of all homes as one set, by kind and method: calibration needs many steps."""
    keys = homes[0].drives if homes else {}
    return {key: summary([home.drives[key] for home in homes]) for key in keys}
