"""Modelling as a fold: what comes out does not depend on how the scans come in."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

from core.log_readers import read_log
from core.pipeline.growing_model import METHODS, GrowingModel, MethodName, grown_along
from core.pipeline.mapper import MappingOptions
from core.pipeline.modeller import ModellingOptions, model_log
from core.pipeline.region_finder import found_so_far
from core.sensing import RobotLog, Trajectory
from core.sensing.robot_log import join

SCANS = 900
"""Of the drive, some 35 m through three rooms."""
SAMPLES = Path(__file__).parents[3] / "sample_logs"


@pytest.fixture(scope="module")
def drive() -> RobotLog:
    return read_log(SAMPLES / "flat-mapping.jsonl.gz").log.without_truth().slice(0, SCANS)


@pytest.fixture(scope="module")
def grown(drive: RobotLog) -> GrowingModel:
    """The model of the whole drive in one go."""
    poses = Trajectory.from_odometry(drive)
    return grown_along(drive, poses, MappingOptions(), METHODS["default"])


def test_a_model_that_was_saved_and_loaded_half_way_comes_to_the_same(
    drive: RobotLog, grown: GrowingModel
) -> None:
    model = GrowingModel(drive.ring)
    for i, scan in enumerate(drive):
        if i == len(drive) // 2:
            model = pickle.loads(pickle.dumps(model))
        model.add(scan, drive.odometry[i])
    assert model.state.history == grown.state.history
    np.testing.assert_array_equal(found_so_far(model).regions, found_so_far(grown).regions)


def test_finishing_on_the_way_changes_nothing(drive: RobotLog, grown: GrowingModel) -> None:
    model = GrowingModel(drive.ring)
    ends = []
    for i, scan in enumerate(drive):
        if model.add(scan, drive.odometry[i]) and len(model.state.pictures) % 5 == 0:
            ends.append(found_so_far(model))
    assert model.state.history == grown.state.history
    assert all(end.regions.any() for end in ends)


def test_a_drive_in_two_logs_is_one_drive(drive: RobotLog) -> None:
    options = ModellingOptions(odometry="raw")
    middle = len(drive) // 2
    parts = join(drive.slice(0, middle), drive.slice(middle, len(drive)))
    whole, in_two = model_log(drive, options), model_log(parts, options)
    np.testing.assert_array_equal(in_two.regions, whole.regions)
    assert in_two.topology == whole.topology


@pytest.mark.parametrize("method", ["default", "paper"])
def test_a_step_is_taken_at_every_multiple_of_its_distance(
    square_room: RobotLog, method: MethodName
) -> None:
    model = GrowingModel(square_room.ring, method=METHODS[method])
    at = [
        model.driven
        for i, scan in enumerate(square_room)
        if model.add(scan, square_room.odometry[i])
    ]
    assert [int(driven / 2.5) for driven in at] == [1, 2]
    assert len(model.state.pictures) == 2


def test_the_log_odds_baseline_grows_too(square_room: RobotLog) -> None:
    poses = Trajectory.from_odometry(square_room)
    model = grown_along(square_room, poses, MappingOptions("bayes"), METHODS["default"])
    assert len(np.unique(found_so_far(model).regions)) == 2


def test_a_drive_without_an_echo_has_what_the_robot_covered(square_room: RobotLog) -> None:
    model = GrowingModel(square_room.ring)
    for i, scan in enumerate(square_room):
        silent = type(scan)(scan.t, scan.odometry, np.full_like(scan.ranges, np.nan), scan.fresh)
        model.add(silent, square_room.odometry[i])
    assert found_so_far(model).regions.any()


def test_a_longer_drive_keeps_the_ids_of_the_regions_that_were_there(drive: RobotLog) -> None:
    options = ModellingOptions(odometry="raw")
    first = model_log(drive.slice(0, 2 * SCANS // 3), options)
    longer = model_log(drive, options, previous=first)
    now = {node.id: node.region for node in longer.topology.nodes}
    kept = 0
    for node in first.topology.nodes:
        cells = first.grid.geometry.world_of(np.argwhere(first.regions == node.region))
        row, col = longer.grid.geometry.cell_of(cells).T
        if node.id in now:
            kept += 1
            assert (longer.regions[row, col] == now[node.id]).mean() > 0.3
        else:
            assert any(node.id in other.came_from for other in longer.topology.nodes)
    assert kept >= len(first.topology.nodes) - 1
    assert len(set(now)) == len(longer.topology.nodes)
