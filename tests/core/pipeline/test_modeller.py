from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError, MapError, UsageError
from core.pipeline.mapper import MappingOptions, map_log
from core.pipeline.modeller import ModellingOptions, model_log, model_map
from core.sensing import RobotLog, Trajectory
from core.topology.labels import label_node


def test_a_model_says_what_it_was_made_of(square_room: RobotLog) -> None:
    model = model_log(square_room, ModellingOptions(regions=2, seed=4))
    assert model.provenance["inputs"][0]["scans"] == len(square_room)
    assert model.provenance["options"]["seed"] == 4
    assert model.provenance["mapping"]["resolution"] == 0.05
    assert len(model.topology.nodes) == 2


def test_a_model_is_the_same_with_and_without_ground_truth(square_room: RobotLog) -> None:
    with_truth = replace(square_room, truth=square_room.odometry + 5.0)
    options = ModellingOptions(regions=2)
    np.testing.assert_array_equal(
        model_log(with_truth, options).regions, model_log(square_room, options).regions
    )


def test_labels_of_an_earlier_model_are_kept(square_room: RobotLog) -> None:
    first = model_log(square_room, ModellingOptions(regions=1))
    named = replace(first, topology=label_node(first.topology, first.topology.nodes[0].id, "den"))
    second = model_log(square_room, ModellingOptions(regions=1), previous=named)
    assert second.topology.nodes[0].label == "den"


def test_autonomous_with_a_number_of_regions_cannot_be() -> None:
    with pytest.raises(UsageError, match="number of regions itself"):
        ModellingOptions(mode="autonomous", regions=3)


def test_autonomous_from_a_map_cannot_be(square_room: RobotLog) -> None:
    grid = map_log(square_room, Trajectory.from_odometry(square_room)).grid
    with pytest.raises(UsageError, match="needs a log"):
        model_map(grid, ModellingOptions(mode="autonomous"))


def test_a_map_by_the_papers_method_needs_the_number_of_regions(square_room: RobotLog) -> None:
    grid = map_log(square_room, Trajectory.from_odometry(square_room)).grid
    with pytest.raises(UsageError, match="number of regions"):
        model_map(grid, ModellingOptions(method="paper"))


def test_a_map_without_a_drive_is_modelled_too(square_room: RobotLog) -> None:
    grid = map_log(square_room, Trajectory.from_odometry(square_room)).grid
    model = model_map(grid, ModellingOptions(mode="offline", regions=2))
    assert len(model.topology.nodes) == 2
    assert model.trajectory is None


def test_a_log_without_an_echo_is_refused(square_room: RobotLog) -> None:
    silent = replace(square_room, ranges=np.full(square_room.ranges.shape, np.nan))
    with pytest.raises(MapError, match="no usable echo"):
        model_log(silent, ModellingOptions(regions=1))


def test_a_resolution_that_no_sonar_gives_is_refused() -> None:
    with pytest.raises(InputError, match="resolution"):
        MappingOptions(resolution=0.001)
