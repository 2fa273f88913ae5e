"""A drive that has not ended has poses, a map and regions at every moment."""

from __future__ import annotations

import pickle
from itertools import takewhile

import numpy as np
import pytest

from core.errors import InputError, MapError
from core.pipeline.growing_drive import GrowingDrive
from core.pipeline.modeller import ModellingOptions, model_log
from core.sensing import RobotLog
from core.simulation import simulate
from core.topology import Model
from core.topology.timeline import moments

RAW = ModellingOptions(odometry="raw")


@pytest.fixture(scope="module")
def drive() -> RobotLog:
    log = simulate("paper", seed=4, odometry="calibrated").without_truth()
    return log.slice(0, 700)


def fed(log: RobotLog, options: ModellingOptions) -> GrowingDrive:
    growing = GrowingDrive(log.ring, options)
    for scan in log:
        growing.add(scan)
    return growing


def test_with_raw_odometry_the_regions_extracted_on_the_way_are_those_of_the_log(
    drive: RobotLog,
) -> None:
    live, batch = fed(drive, RAW).model("live"), model_log(drive, RAW)

    def on_the_way(model: Model) -> list[dict[str, object]]:
        found = takewhile(lambda m: "end of the drive" not in m["said"], moments(model.history))
        return [d for m in found for d in m["decisions"] if d["accepted"]]

    assert on_the_way(live) == on_the_way(batch)
    assert on_the_way(live)


def test_a_step_is_taken_every_2_m_and_a_half(drive: RobotLog) -> None:
    growing = GrowingDrive(drive.ring, RAW)
    at = [growing.driven for scan in drive if growing.add(scan)]
    assert np.floor(np.array(at) / 2.5).tolist() == list(range(1, len(at) + 1))


def test_a_drive_that_was_put_aside_goes_on_as_if_nothing_had_happened(drive: RobotLog) -> None:
    growing = fed(drive.slice(0, 300), ModellingOptions())
    back = pickle.loads(pickle.dumps(growing))
    for scan in drive.slice(300, 500):
        assert growing.add(scan) == back.add(scan)
    np.testing.assert_array_equal(growing.pose, back.pose)
    one, two = growing.model("a"), back.model("a")
    np.testing.assert_array_equal(one.regions, two.regions)
    assert one.topology == two.topology


def test_before_the_first_echo_there_is_nothing_to_map(drive: RobotLog) -> None:
    silent = RobotLog(
        "silent",
        drive.ring,
        drive.t[:1],
        drive.odometry[:1],
        np.full((1, len(drive.ring)), np.nan),
        np.ones((1, len(drive.ring)), bool),
    )
    with pytest.raises(MapError, match="no usable echo yet"):
        fed(silent, ModellingOptions()).model("silent")


def test_a_number_of_regions_needs_the_whole_log(drive: RobotLog) -> None:
    with pytest.raises(InputError, match="not ended"):
        GrowingDrive(drive.ring, ModellingOptions(regions=3))
