"""Is the simulated sonar as bad as a real one?

The real log is an office corridor driven with eight sonars of about 20 degrees; its laser gave true
poses but no walls. So both logs are measured in the same way: the walls are those of the CEMAL map
made at the true poses, and a reading is compared with the wall on the sonar's axis. The simulated
robot has the same ring and drives through an L-shaped office corridor with door niches.
"""

from __future__ import annotations

import math
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from core.geometry import FloatArray, compose
from core.log_readers import read_log
from core.mapping.cemal import cemal_map
from core.mapping.occupancy_grid import OccupancyGrid
from core.sensing import RobotLog, Trajectory
from core.simulation import simulate

DESCRIPTION = Path(__file__).parents[1] / "log_readers" / "corridor_test1.yaml"
WITHIN = 4.0
PUBLISHED = {"no echo": (0.06, 0.19), "too long": (0.05, 0.20), "too short": (0.05, 0.31)}
"""Spread over channels as the data's own description gives it, from the laser's walls."""


@dataclass(frozen=True)
class Shares:
    """Per channel: shares of its fresh readings that are missing or wrong."""

    no_echo: FloatArray
    too_long: FloatArray
    too_short: FloatArray


def shares(log: RobotLog) -> Shares:
    assert log.truth is not None
    grid = cemal_map(log, Trajectory.at(log.t, log.truth)).grid
    rows = []
    for s, sonar in enumerate(log.ring.sonars):
        fresh = log.fresh[:, s]
        poses = compose(log.truth[fresh], np.array([sonar.x, sonar.y, sonar.heading]))
        wall, reading = walls_ahead(grid, poses), log.ranges[fresh, s]
        off = reading - np.minimum(wall, WITHIN)
        rows.append(
            (
                (np.isnan(reading) & (wall < WITHIN)).mean(),
                ((off > 0.5) & (wall < WITHIN)).mean(),
                (off < -0.3).mean(),
            )
        )
    return Shares(*np.array(rows).T)


def walls_ahead(grid: OccupancyGrid, poses: FloatArray) -> FloatArray:
    """Distance (N,) along each pose's heading to the first occupied cell, inf where there is none."""
    along = np.arange(0.0, WITHIN, grid.geometry.resolution / 3)
    points = poses[:, None, :2] + along[None, :, None] * np.stack(
        (np.cos(poses[:, 2]), np.sin(poses[:, 2])), axis=-1
    ).reshape(-1, 1, 2)
    cells = grid.geometry.cell_of(points)
    inside = grid.geometry.contains(cells)
    hit = np.zeros(inside.shape, bool)
    hit[inside] = grid.occupied[cells[inside][:, 0], cells[inside][:, 1]]
    return np.where(hit.any(axis=1), along[hit.argmax(axis=1)], math.inf)


@pytest.fixture(scope="module")
def real_log(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> RobotLog:
    folder = tmp_path_factory.mktemp("real") / "corridor"
    shutil.copytree(data_dir / "logs" / "corridor_test1", folder)
    shutil.copy(DESCRIPTION, folder / "log.yaml")
    return read_log(folder).log


@pytest.fixture(scope="module")
def real(real_log: RobotLog) -> Shares:
    return shares(real_log)


@pytest.fixture(scope="module")
def simulated(real_log: RobotLog) -> Shares:
    return shares(simulate("office", seed=1, tour="localization", ring=real_log.ring))


@pytest.mark.data
@pytest.mark.parametrize("what", list(PUBLISHED))
def test_the_mean_channel_is_within_the_spread_of_the_real_channels(
    what: str, real: Shares, simulated: Shares
) -> None:
    name = what.replace(" ", "_")
    of_real, mean = getattr(real, name), getattr(simulated, name).mean()
    assert of_real.min() <= mean <= of_real.max()
    low, high = PUBLISHED[what]
    assert low <= mean <= high


@pytest.mark.data
def test_sonars_that_look_at_the_walls_squarely_miss_them_least(
    real: Shares, simulated: Shares
) -> None:
    side, slanting = [0, 7], [1, 2, 5, 6]
    for one in (real, simulated):
        assert one.no_echo[side].mean() < 0.5 * one.no_echo[slanting].mean()
        assert one.too_long[side].mean() < one.too_long[slanting].mean()
