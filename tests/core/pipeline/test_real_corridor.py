"""The real corridor log: eight sonars, odometry that ends 0.8 m off, poses from a laser beside it."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from core.geometry import compose, rigid_fit
from core.log_readers import read_log
from core.mapping import OccupancyGrid
from core.pipeline.corrected_drive import corrected_drive
from core.pipeline.mapper import map_log
from core.sensing import RobotLog, Trajectory

LOG_YAML = Path(__file__).parents[1] / "log_readers" / "corridor_test1.yaml"


@pytest.fixture(scope="module")
def corridor(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> RobotLog:
    folder = tmp_path_factory.mktemp("corridor")
    for file in (data_dir / "logs" / "corridor_test1").glob("*.txt"):
        shutil.copy(file, folder)
    shutil.copy(LOG_YAML, folder / "log.yaml")
    return read_log(folder).log


@pytest.fixture(scope="module")
def laser_map(corridor: RobotLog) -> OccupancyGrid:
    assert corridor.truth is not None
    return map_log(corridor, Trajectory.at(corridor.t, corridor.truth)).grid


def free_iou(a: OccupancyGrid, b: OccupancyGrid) -> float:
    cells = a.geometry.cell_of(b.geometry.world_of(np.argwhere(b.free)))
    cells = cells[a.geometry.contains(cells)]
    shared = int(a.free[cells[:, 0], cells[:, 1]].sum())
    return shared / (int(a.free.sum()) + int(b.free.sum()) - shared)


@pytest.mark.data
def test_the_map_by_default_is_that_of_the_laser_poses(
    corridor: RobotLog, laser_map: OccupancyGrid
) -> None:
    assert corridor.truth is not None
    drive = corrected_drive(corridor, "corrected")
    grid = map_log(drive.log, drive.trajectory).grid
    assert free_iou(grid, laser_map) >= 0.85
    cells = grid.geometry.cell_of(drive.trajectory.poses[:, :2])
    assert grid.free[cells[:, 0], cells[:, 1]].all()
    off = np.hypot(*(drive.trajectory.poses - corridor.truth)[:, :2].T).mean()
    raw = np.hypot(*(corridor.odometry - corridor.truth)[:, :2].T).mean()
    assert off <= raw / 2


@pytest.mark.data
def test_the_odometry_as_it_is_gives_the_right_shape(
    corridor: RobotLog, laser_map: OccupancyGrid
) -> None:
    assert corridor.truth is not None
    fit = rigid_fit(corridor.truth[:, :2], corridor.odometry[:, :2])
    grid = map_log(corridor, Trajectory.at(corridor.t, compose(fit, corridor.odometry))).grid
    assert free_iou(grid, laser_map) >= 0.80
