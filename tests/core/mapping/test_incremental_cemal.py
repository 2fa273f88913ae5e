"""The live map is the batch map of the same scans, at every moment of a drive."""

from __future__ import annotations

import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from core.errors import MapError
from core.log_readers import read_log
from core.mapping.cemal import cemal_map
from core.mapping.incremental_cemal import IncrementalCemal
from core.mapping.map_result import MapResult
from core.sensing import RobotLog, Trajectory
from core.simulation.drive import simulate

MOST_DIFFERENT = 0.001
"""Share of known cells; the product asks for 0.01, rounding at cell borders remains."""


def batch(log: RobotLog) -> MapResult:
    return cemal_map(log, Trajectory.from_odometry(log))


def on_common_grid(
    result: MapResult, values: np.ndarray, low: np.ndarray, shape: np.ndarray
) -> np.ndarray:
    geometry = result.grid.geometry
    col, row = np.round((np.array(geometry.origin[:2]) - low) / geometry.resolution).astype(int)
    common = np.zeros(shape, values.dtype)
    common[row : row + geometry.shape[0], col : col + geometry.shape[1]] = values
    return common


def share_of_different_cells(a: MapResult, b: MapResult) -> float:
    """Share of the known cells that differ in state or in how many readings free them."""
    grids = [a.grid.geometry, b.grid.geometry]
    low = np.min([g.origin[:2] for g in grids], axis=0)
    high = np.max([np.array(g.origin[:2]) + np.array(g.shape[::-1]) * 0.05 for g in grids], axis=0)
    shape = np.round((high - low)[::-1] / 0.05).astype(int)
    one, other = (on_common_grid(r, r.grid.state, low, shape) for r in (a, b))
    freed, freed_too = (on_common_grid(r, r.witnesses, low, shape) for r in (a, b))
    different = (one != other) | (freed != freed_too)
    return float(different.sum() / ((one > 0) | (other > 0)).sum())


def assert_same_at(log: RobotLog, moments: tuple[int, ...]) -> None:
    growing = IncrementalCemal(log.ring)
    for i, scan in enumerate(log):
        growing.add(scan, scan.odometry)
        if i + 1 in moments:
            expected, live = batch(log.slice(0, i + 1)), growing.result()
            assert (live.kept != expected.kept).mean() < MOST_DIFFERENT
            assert share_of_different_cells(live, expected) < MOST_DIFFERENT


@pytest.fixture(scope="module")
def paper_drive() -> RobotLog:
    return simulate("paper", seed=3, odometry="calibrated").without_truth()


def test_live_and_batch_map_agree_all_along_a_simulated_drive(paper_drive: RobotLog) -> None:
    sparse = paper_drive.taken(np.arange(0, 1600, 4))
    assert_same_at(sparse, (1, 40, 150, 400))


def test_every_scan_of_a_stretch_can_be_used(paper_drive: RobotLog) -> None:
    assert_same_at(paper_drive.slice(0, 120), (60, 120))


def test_readings_that_are_wrong_are_dropped_and_come_back_as_the_batch_has_it(
    square_room: RobotLog,
) -> None:
    ranges = square_room.ranges.copy()
    ranges[10, 2], ranges[25, 2] = 1.3, 3.9  # an echo out of nothing, an echo through the wall
    assert_same_at(replace(square_room, ranges=ranges), (11, 12, 26, 27, 50, len(square_room)))


@pytest.mark.data
@pytest.mark.slow
@pytest.mark.parametrize("name", ["home21_map", "home21_mapbad"])
def test_live_and_batch_map_agree_on_another_simulator_s_logs(data_dir: Path, name: str) -> None:
    log = read_log(data_dir / "homes" / "logs" / f"{name}.jsonl.gz").log.without_truth()
    sparse = log.taken(np.arange(0, len(log), 4))
    assert_same_at(sparse, (200, len(sparse)))


def test_a_map_that_was_saved_and_loaded_in_mid_drive_goes_on_alike(square_room: RobotLog) -> None:
    through, saved = IncrementalCemal(square_room.ring), IncrementalCemal(square_room.ring)
    for i, scan in enumerate(square_room):
        through.add(scan, scan.odometry)
        if i % 20 == 10:
            saved = pickle.loads(pickle.dumps(saved))
        saved.add(scan, scan.odometry)
    np.testing.assert_array_equal(through.result().grid.state, saved.result().grid.state)
    np.testing.assert_array_equal(through.result().confidence, saved.result().confidence)


def test_the_grid_grows_with_the_drive(square_room: RobotLog) -> None:
    far = square_room.odometry + np.array([30.0, -20.0, 0.0])
    both = replace(
        square_room,
        t=np.arange(2 * len(square_room)) * 0.25,
        odometry=np.concatenate((square_room.odometry, far)),
        ranges=np.concatenate((square_room.ranges, square_room.ranges)),
        fresh=np.concatenate((square_room.fresh, square_room.fresh)),
    )
    assert_same_at(both, (len(both),))


def test_before_the_first_scan_the_map_has_no_cells(square_room: RobotLog) -> None:
    assert IncrementalCemal(square_room.ring).result().grid.state.size == 0


def test_a_jump_across_the_country_is_refused_and_the_map_stays(square_room: RobotLog) -> None:
    growing = IncrementalCemal(square_room.ring)
    first = square_room.scan(0)
    growing.add(first, first.odometry)
    with pytest.raises(MapError, match="check the units"):
        growing.add(square_room.scan(1), np.array([9000.0, 0.0, 0.0]))
    growing.add(square_room.scan(1), square_room.scan(1).odometry)
    assert share_of_different_cells(growing.result(), batch(square_room.slice(0, 2))) == 0
