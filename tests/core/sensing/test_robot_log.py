from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.sensing import RING_PRESETS, RobotLog
from core.sensing.robot_log import join


@pytest.fixture
def log() -> RobotLog:
    """Five scans, one a second, 0.5 m apart."""
    t = np.arange(5.0)
    poses = np.column_stack((t * 0.5, np.zeros(5), np.zeros(5)))
    ranges = np.arange(40.0).reshape(5, 8)
    fresh = np.ones((5, 8), bool)
    return RobotLog("drive", RING_PRESETS["circle-8"], t, poses, ranges, fresh, poses + 1)


def test_duration_and_distance(log: RobotLog) -> None:
    assert (log.duration_s, log.distance_m) == (4.0, 2.0)
    empty = log.slice(0, 0)
    assert (len(empty), empty.duration_s, empty.distance_m) == (0, 0.0, 0.0)


def test_scans_come_one_by_one(log: RobotLog) -> None:
    scans = list(log)
    assert [scan.t for scan in scans] == [0, 1, 2, 3, 4]
    assert scans[3].ranges.tolist() == list(range(24, 32))
    assert not hasattr(scans[0], "truth")


def test_parts_joined_again_are_the_whole(log: RobotLog) -> None:
    whole = join(log.slice(0, 2), log.slice(2, 5))
    for field in ("t", "odometry", "ranges", "fresh", "truth"):
        np.testing.assert_array_equal(getattr(whole, field), getattr(log, field))


def test_truth_is_joined_only_if_both_have_it(log: RobotLog) -> None:
    assert log.without_truth().truth is None
    assert join(log.slice(0, 2).without_truth(), log.slice(2, 5)).truth is None


def test_logs_of_different_drives_are_not_joined(log: RobotLog) -> None:
    with pytest.raises(InputError, match="not one drive"):
        join(log, log)
    with pytest.raises(InputError, match="another sonar ring"):
        join(log, replace(log, ring=RING_PRESETS["p3dx-front-8"]))


def test_arrays_that_do_not_fit_together_are_refused(log: RobotLog) -> None:
    with pytest.raises(InputError, match="do not fit together"):
        replace(log, ranges=log.ranges[:, :7])
