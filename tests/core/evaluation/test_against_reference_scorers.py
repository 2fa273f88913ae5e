"""Our metrics and the scorers that came with the data agree on the same models."""

from __future__ import annotations

import importlib.util
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from skimage.io import imread

from core.evaluation import GroundTruth, map_metrics, region_metrics, room_metrics
from core.log_readers import read_log
from core.mapping.occupancy_grid import GridGeometry
from core.pipeline.modeller import ModellingOptions, model_log
from core.topology import Model
from core.topology.model_folder import write_model

CLOSE = 0.005
HOME = "home22"


@pytest.fixture(scope="module")
def scorers(data_dir: Path) -> Iterator[Path]:
    sys.path.insert(0, str(data_dir / "homes"))
    yield data_dir
    sys.path.remove(str(data_dir / "homes"))


@pytest.fixture(scope="module")
def model(data_dir: Path) -> Model:
    log = read_log(data_dir / "homes" / "logs" / f"{HOME}_map.jsonl.gz").log
    return model_log(log, ModellingOptions(regions=6, mode="offline", odometry="raw"))


@pytest.fixture(scope="module")
def folder(model: Model, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("model") / "m"
    write_model(model, path)
    return path


def load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"reference_{path.stem}", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def truth_of_npz(path: Path) -> GroundTruth:
    file = np.load(path)
    meta = json.loads(str(file["meta"]))
    return GroundTruth(
        GridGeometry(meta["resolution"], (*meta["origin"], 0.0), file["occupied"].shape),
        file["occupied"],
        file["free"],
        file["explored"],
        file["rooms"].astype(np.int64),
        tuple(meta["rooms"]),
        np.array(meta["doors"], float),
    )


@pytest.mark.data
def test_map_metrics_agree(scorers: Path, model: Model, folder: Path) -> None:
    homes = scorers / "homes"
    reference, common = load(homes / "score_map.py"), load(homes / "common.py")
    truth = homes / "truth" / f"{HOME}.npz"
    theirs = reference.score(common.load_map(folder), common.load_truth(truth))
    ours = map_metrics(model.grid, truth_of_npz(truth))
    assert len(theirs) == 13
    for name, value in theirs.items():
        assert getattr(ours, name) == pytest.approx(value, abs=CLOSE), name


@pytest.mark.data
def test_region_metrics_agree(scorers: Path, model: Model, folder: Path) -> None:
    homes = scorers / "homes"
    reference, common = load(homes / "score_regions.py"), load(homes / "common.py")
    truth = homes / "truth" / f"{HOME}.npz"
    theirs = reference.score(*common.load_model(folder), common.load_truth(truth))
    ours = region_metrics(model.regions, model.grid.geometry, truth_of_npz(truth))
    for name in (
        "count",
        "rooms_true",
        "coverage",
        "purity",
        "ari",
        "best_iou_mean",
        "merged_iou_mean",
        "hidden_mean",
        "hidden_max",
        "smallest_m2",
    ):
        assert getattr(ours, name) == pytest.approx(theirs[name], abs=CLOSE), name


@pytest.mark.data
def test_room_metrics_agree(data_dir: Path) -> None:
    reference = load(data_dir / "rooms" / "evaluate.py")
    maps = data_dir / "rooms" / "maps"
    name = "home__ex1"
    image, truth = (
        np.asarray(imread(maps / f"{name}{suffix}.png")).astype(np.int64) for suffix in ("", "_gt")
    )
    guess = np.maximum(truth, np.roll(truth, 25, axis=1))
    theirs = reference.score(guess, truth, image)
    ours = room_metrics(guess, truth, image >= 250)
    assert 0.0 < ours.pq < 1.0
    for key, value in theirs.items():
        assert getattr(ours, key) == pytest.approx(float(value), abs=CLOSE), key
