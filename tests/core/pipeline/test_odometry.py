"""Which poses a drive is mapped at, on simulated drives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.geometry import wrap_angle
from core.mapping.odometry_breaks import BreakKind
from core.pipeline.odometry import trajectory_for
from core.sensing import RobotLog
from core.simulation import DriveConfig, simulate

DRIVE = DriveConfig(mapping_length=45.0)
SCANS = 1400
"""Some 50 m, with enough places seen twice."""


def mean_error(poses: np.ndarray, log: RobotLog) -> float:
    assert log.truth is not None
    return float(np.hypot(*(poses - log.truth)[:, :2].T).mean())


@pytest.fixture(scope="module")
def drifted() -> RobotLog:
    return simulate("paper", seed=3, odometry="bad", config=DRIVE).slice(0, SCANS)


@pytest.fixture(scope="module")
def exact(drifted: RobotLog) -> RobotLog:
    assert drifted.truth is not None
    return replace(drifted, odometry=drifted.truth)


def test_bad_odometry_is_corrected(drifted: RobotLog) -> None:
    result = trajectory_for(drifted)

    assert result.used == "corrected"
    assert mean_error(result.trajectory.poses, drifted) < 0.4 * mean_error(
        drifted.odometry, drifted
    )
    assert result.trajectory.poses[0] == pytest.approx(drifted.odometry[0], abs=1e-6)
    assert any(closure.accepted for closure in result.closures)
    assert np.isfinite(result.trajectory.sigma_xy).all()


def test_the_same_log_gives_the_same_trajectory(drifted: RobotLog) -> None:
    part = drifted.slice(0, 400)

    first, second = trajectory_for(part), trajectory_for(part)

    assert (first.trajectory.poses == second.trajectory.poses).all()


def test_truth_in_the_log_changes_nothing(drifted: RobotLog) -> None:
    part = drifted.slice(0, 300)

    assert (
        trajectory_for(part).trajectory.poses
        == trajectory_for(part.without_truth()).trajectory.poses
    ).all()


def test_true_odometry_is_left_alone(exact: RobotLog) -> None:
    result = trajectory_for(exact)

    off = result.trajectory.poses - exact.odometry
    assert np.hypot(*off[:, :2].T).max() < 0.05
    assert np.degrees(np.abs(wrap_angle(off[:, 2]))).max() < 0.5


def test_raw_is_the_odometry_untouched(drifted: RobotLog) -> None:
    result = trajectory_for(drifted, "raw")

    assert result.used == "raw"
    assert (result.trajectory.poses == drifted.odometry).all()
    assert result.calibration is None


def test_a_jump_of_the_odometry_is_taken_out_and_told(exact: RobotLog) -> None:
    odometry = exact.odometry.copy()
    odometry[500:, 0] += 1.0

    result = trajectory_for(replace(exact, odometry=odometry))

    assert [(b.scan, b.kind) for b in result.breaks] == [(500, BreakKind.JUMP)]
    assert mean_error(result.trajectory.poses, exact) < 0.1
    assert "jumps by 1.0" in result.sentences[0]


def test_a_carried_robot_splits_the_drive() -> None:
    whole = simulate("paper", seed=2, odometry="calibrated", kidnap=True, config=DRIVE)
    assert whole.truth is not None
    step = np.hypot(*np.diff(whole.truth[:, :2], axis=0).T)
    middle = int(step.argmax()) + 1
    log, carried_at = whole.slice(middle - 400, middle + 500), 400

    result = trajectory_for(log)

    assert [(b.scan, b.kind) for b in result.breaks] == [(carried_at, BreakKind.CARRIED)]
    assert carried_at in result.part
    assert any("split" in sentence for sentence in result.sentences)


def test_a_robot_that_spins_on_the_spot_stays_there() -> None:
    log = simulate("paper", seed=1, odometry="bad", tour="spin")

    result = trajectory_for(log)

    assert np.hypot(*(result.trajectory.poses - log.odometry)[:, :2].T).max() < 0.1


@pytest.mark.parametrize("scans", [0, 1, 2, 3, 10])
def test_a_very_short_log_keeps_its_odometry(drifted: RobotLog, scans: int) -> None:
    part = drifted.slice(0, scans)

    result = trajectory_for(part)

    assert len(result.trajectory) == scans
    assert result.trajectory.poses == pytest.approx(part.odometry, abs=0.02)


def test_a_log_without_echoes_keeps_its_odometry(drifted: RobotLog) -> None:
    part = drifted.slice(0, 200)
    silent = replace(part, ranges=np.full(part.ranges.shape, np.nan))

    result = trajectory_for(silent)

    assert result.used == "raw"
    assert result.trajectory.poses == pytest.approx(silent.odometry, abs=1e-9)
