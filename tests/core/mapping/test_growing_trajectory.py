"""Drift correction while the robot drives."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest

from core.geometry import FloatArray
from core.mapping.growing_trajectory import GrowingTrajectory
from core.sensing import RobotLog
from core.simulation import DriveConfig, simulate

CELL = 0.05


@pytest.fixture(scope="module")
def drifted() -> RobotLog:
    config = DriveConfig(mapping_length=45.0)
    return simulate("paper", seed=3, odometry="bad", config=config).slice(0, 1400)


def grown(log: RobotLog) -> GrowingTrajectory:
    trajectory = GrowingTrajectory(log.ring)
    for scan in log.without_truth():
        trajectory.add(scan)
    return trajectory


@pytest.fixture(scope="module")
def whole(drifted: RobotLog) -> GrowingTrajectory:
    return grown(drifted)


def mean_error(poses: FloatArray, log: RobotLog) -> float:
    assert log.truth is not None
    return float(np.hypot(*(poses - log.truth)[:, :2].T).mean())


def test_bad_odometry_is_corrected_before_the_drive_ends(
    drifted: RobotLog, whole: GrowingTrajectory
) -> None:
    poses = whole.told()

    assert len(poses) == len(drifted)
    assert mean_error(poses, drifted) < 0.4 * mean_error(drifted.odometry, drifted)
    assert poses[0] == pytest.approx(drifted.odometry[0], abs=1e-6)
    assert any(closure.accepted for closure in whole.closures)


def test_it_goes_on_from_a_pickle_as_if_nothing_had_happened(drifted: RobotLog) -> None:
    through, kept = GrowingTrajectory(drifted.ring), GrowingTrajectory(drifted.ring)
    for i, scan in enumerate(drifted.slice(0, 500).without_truth()):
        through.add(scan)
        kept.add(scan)
        if i == 300:
            kept = pickle.loads(pickle.dumps(kept))

    assert (kept.told() == through.told()).all()


def test_moved_poses_are_announced(drifted: RobotLog) -> None:
    trajectory = GrowingTrajectory(drifted.ring)
    shown: list[FloatArray] = []
    for scan in drifted.slice(0, 700).without_truth():
        shown.append(trajectory.add(scan))
        off = np.hypot(*(np.array(shown) - np.array(trajectory._poses))[:, :2].T).max()
        assert trajectory.moved == pytest.approx(off, abs=1e-9)
        if trajectory.moved > CELL:
            shown = list(trajectory.told())
            assert trajectory.moved == 0.0


def test_true_odometry_moves_by_less_than_two_cells(drifted: RobotLog) -> None:
    assert drifted.truth is not None

    poses = grown(replace(drifted, odometry=drifted.truth)).told()

    assert mean_error(poses, drifted) < 2 * CELL


def test_a_jump_of_the_odometry_is_left_out(drifted: RobotLog) -> None:
    part = drifted.slice(0, 300)
    jumped = part.odometry.copy()
    jumped[200:, 0] += 1.0

    poses = grown(replace(part, odometry=jumped)).told()

    assert poses == pytest.approx(grown(part).told(), abs=CELL)


def test_a_drive_without_echoes_follows_the_odometry(drifted: RobotLog) -> None:
    part = drifted.slice(0, 300)
    silent = replace(part, ranges=np.full(part.ranges.shape, np.nan))

    assert grown(silent).told() == pytest.approx(part.odometry, abs=1e-6)
