"""Homes of an independent simulator: what the README claims must hold there."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from core.evaluation.ground_truth import GroundTruth
from core.evaluation.map_metrics import map_metrics
from core.evaluation.region_metrics import region_metrics
from core.log_readers import read_log
from core.mapping import GridGeometry
from core.pipeline.mapper import map_log
from core.pipeline.modeller import ModellingOptions, model_log
from core.sensing import RobotLog, Trajectory

HOMES = ("home21", "home22", "home23", "home24")
RESOLUTION = 0.05


def drive(data_dir: Path, name: str) -> RobotLog:
    return read_log(data_dir / "homes" / "logs" / f"{name}.jsonl.gz").log


def truth(data_dir: Path, home: str) -> GroundTruth:
    file = np.load(data_dir / "homes" / "truth" / f"{home}.npz", allow_pickle=False)
    meta = json.loads(str(file["meta"]))
    occupied = file["occupied"].astype(bool)
    geometry = GridGeometry(RESOLUTION, (*meta["origin"], 0.0), occupied.shape)
    return GroundTruth(
        geometry,
        occupied,
        file["free"].astype(bool),
        file["explored"].astype(bool),
        file["rooms"].astype(np.int64),
        tuple(meta["rooms"]),
        np.array(meta["doors"], float),
    )


@pytest.mark.data
def test_cemal_is_at_least_as_good_as_the_prototype_on_four_homes(data_dir: Path) -> None:
    rows = []
    for home in HOMES:
        log = drive(data_dir, f"{home}_map")
        grid = map_log(log, Trajectory.from_odometry(log)).grid
        rows.append(map_metrics(grid, truth(data_dir, home)))
    assert np.mean([row.recall_1 for row in rows]) >= 0.62
    assert np.mean([row.recall_2 for row in rows]) >= 0.80
    assert np.mean([row.precision_1 for row in rows]) >= 0.70
    assert np.mean([row.free_iou for row in rows]) >= 0.87
    assert np.mean([row.leak_m2 for row in rows]) <= 2.2
    assert sum(row.doors_blocked for row in rows) == 0


@pytest.mark.data
def test_ten_regions_are_pure(data_dir: Path) -> None:
    purity = []
    for home in HOMES:
        options = ModellingOptions(mode="offline", regions=10, odometry="raw")
        model = model_log(drive(data_dir, f"{home}_map"), options)
        metrics = region_metrics(model.regions, model.grid.geometry, truth(data_dir, home))
        purity.append(metrics.purity)
    assert np.mean(purity) >= 0.95
