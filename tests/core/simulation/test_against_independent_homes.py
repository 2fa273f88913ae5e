"""Does the simulated sonar err about as often as that of a simulator that nobody tuned to ours?

Each reading is compared with the nearest solid cell inside the beam, at the true pose.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from core.geometry import BoolArray, FloatArray, compose
from core.log_readers import read_log
from core.mapping.occupancy_grid import GridGeometry
from core.sensing import RobotLog
from core.simulation import Home, truth_of

STRIDE = 20
"""Every so many scans are looked at."""
RAYS = 15


def errors(log: RobotLog, occupied: BoolArray, geometry: GridGeometry) -> FloatArray:
    """Shares of readings without echo, > 0.5 m too long, > 0.3 m too short; and their spread (m)."""
    assert log.truth is not None
    off, missing = [], []
    for s, sonar in enumerate(log.ring.sonars):
        poses = compose(log.truth[::STRIDE], np.array([sonar.x, sonar.y, sonar.heading]))
        nearest = nearest_in_beam(occupied, geometry, poses, sonar.beam_width, sonar.max_range)
        seen = nearest < sonar.max_range - 0.2
        reading = log.ranges[::STRIDE, s][seen]
        missing.append(np.isnan(reading))
        off.append(reading - nearest[seen])
    error, lost = np.concatenate(off), np.concatenate(missing)
    close = error[np.abs(error) < 0.3]
    return np.array([lost.mean(), (error > 0.5).mean(), (error < -0.3).mean(), close.std()])


def nearest_in_beam(
    occupied: BoolArray, geometry: GridGeometry, poses: FloatArray, beam: float, reach: float
) -> FloatArray:
    along = np.arange(0.0, reach, geometry.resolution / 2)
    best = np.full(len(poses), np.inf)
    for turn in np.linspace(-beam / 2, beam / 2, RAYS):
        heading = poses[:, 2] + turn
        points = poses[:, None, :2] + along[None, :, None] * np.stack(
            (np.cos(heading), np.sin(heading)), axis=-1
        ).reshape(-1, 1, 2)
        cells = geometry.cell_of(points)
        inside = geometry.contains(cells)
        hit = ~inside
        hit[inside] = occupied[cells[inside][:, 0], cells[inside][:, 1]]
        distance = np.where(hit.any(axis=1), along[hit.argmax(axis=1)], np.inf)
        best = np.minimum(best, distance)
    return best


@pytest.mark.data
def test_errors_are_of_the_same_order(data_dir: Path, paper: Home, paper_tour: RobotLog) -> None:
    homes = data_dir / "homes"
    rows = []
    for name in ("home21", "home24"):
        file = np.load(homes / "truth" / f"{name}.npz")
        meta = json.loads(str(file["meta"]))
        geometry = GridGeometry(meta["resolution"], (*meta["origin"], 0.0), file["occupied"].shape)
        log = read_log(homes / "logs" / f"{name}_map.jsonl.gz").log
        rows.append(errors(log, file["occupied"], geometry))
    truth = truth_of(paper)
    ours = errors(paper_tour, truth.occupied, truth.geometry)
    others = np.array(rows)
    names = ("no echo", "too long", "too short", "spread")
    for name, mine, low, high in zip(names, ours, others.min(0), others.max(0), strict=True):
        assert 0.5 * low < mine < 2.0 * high, name
