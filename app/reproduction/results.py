"""`results.json`: every figure of merit with the parameters, versions and seeds that made it."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from app.reproduction.extent import Extent
from app.reproduction.localized_drive import LocalizedDrive
from app.reproduction.many_homes import HomeFigures, spreads, together
from app.reproduction.paper_home_models import HOME, PaperHomeModels, convexities
from app.reproduction.paper_values import PRINTED_VALUES, value_at
from app.reproduction.simulated_truth import ground_truth, judged
from core.simulation import build_home
from core.simulation.home import OUTER_WALL

DECIMALS = 6
PACKAGES = ("echorooms", "numpy", "scipy", "scikit-image", "numba", "plotly")
NOTE = "All drives and homes are simulated. No value here was measured with a real robot."


def results_of(
    extent: Extent,
    paper_home: PaperHomeModels,
    drives: Mapping[str, LocalizedDrive],
    homes: tuple[HomeFigures, ...],
) -> dict[str, Any]:
    """All figures of merit, JSON-able; the same extent gives the same dictionary."""
    results: dict[str, Any] = {
        "note": NOTE,
        "parameters": {
            **asdict(extent),
            "methods": extent.methods,
            "mapping_odometry": extent.odometry,
            "homes_of_the_table": extent.home_names,
            "models": {
                name: {key: model.provenance[key] for key in ("options", "mapping", "segmentation")}
                for name, model in paper_home.models.items()
            },
        },
        "versions": _versions(),
        "paper_home": _paper_home(paper_home, drives),
        "random_homes": {
            "homes": [
                {"name": h.name, "rooms": h.rooms, "nodes": h.nodes, "figures": h.groups}
                for h in homes
            ],
            "spread": spreads(homes),
            "all_steps_together": together(homes),
        },
    }
    plain: dict[str, Any] = _plain(results)
    plain["paper_values"] = [
        {**asdict(value), "ours": value_at(plain, value.key)} for value in PRINTED_VALUES
    ]
    return plain


def _paper_home(
    paper_home: PaperHomeModels, drives: Mapping[str, LocalizedDrive]
) -> dict[str, Any]:
    drive, home = paper_home.drive, build_home(HOME)
    truth = ground_truth(HOME, drive)
    models, quality = {}, None
    for name, model in paper_home.models.items():
        quality, regions = judged(model, drive, truth)
        measures = convexities(model)
        models[name] = {
            "nodes": len(model.topology.nodes),
            "edges": len(model.topology.edges),
            "rooms": len(model.topology.rooms),
            "convexity": measures,
            "convexity_as_printed_max": max((m.as_printed for m in measures), default=0.0),
            "regions": regions,
        }
    bounds = home.bounds
    size = [bounds.x1 - bounds.x0 - OUTER_WALL, bounds.y1 - bounds.y0 - OUTER_WALL]
    resolution = next(iter(paper_home.models.values())).grid.geometry.resolution
    return {
        "size_m": size,
        "speed_m_s": drive.distance_m / drive.duration_s,
        "scan_rate_hz": (len(drive) - 1) / drive.duration_s,
        "resolution_m": resolution,
        "mapping_drive_m": drive.distance_m,
        "map": quality,
        "models": models,
        "localization": {name: _localization(found) for name, found in drives.items()},
    }


def _localization(found: LocalizedDrive) -> dict[str, Any]:
    per_method: dict[str, Any] = {"seed": found.seed, "metres": found.log.distance_m}
    for method, steps in found.steps.items():
        per_method[method] = {
            "score": found.score(method),
            "rejected_steps": [step.step for step in steps if not step.updated],
            "max_probability": [step.probabilities[step.best] for step in steps],
            "unknown": [step.unknown for step in steps],
            "entropy": [step.entropy for step in steps],
            "best_node": [step.best for step in steps],
            "judged": found.judged[method],
        }
    return per_method


def _versions() -> dict[str, str]:
    found = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed"
    return found


def _plain(value: Any) -> Any:
    """JSON-able: dataclasses as objects, numbers rounded, what is not finite as null."""
    if is_dataclass(value) and not isinstance(value, type):
        return _plain(asdict(value))
    if isinstance(value, Mapping):
        return {str(key): _plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_plain(inner) for inner in value]
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, (int, np.integer)):
        return int(value)
    if isinstance(value, (float, np.floating)):
        return round(float(value), DECIMALS) if np.isfinite(value) else None
    return value
