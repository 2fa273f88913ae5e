"""What a person says about the drift of a drive."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.geometry import FloatArray, between, wrap_angle
from core.mapping.drift_config import DriftConfig
from core.mapping.drift_correction import DriftResult, correct_drift
from core.mapping.drift_edits import CLOSURE_ID, Dragged, DriftEdits, SamePlace
from core.mapping.loop_closure import ClosureConfig
from core.sensing import RobotLog
from core.simulation import DriveConfig, simulate

BLIND = DriftConfig(closure=ClosureConfig(min_score=2.0))
"""Believes no closure by itself."""


@pytest.fixture(scope="module")
def drive() -> RobotLog:
    config = DriveConfig(mapping_length=45.0)
    return simulate("paper", seed=3, odometry="bad", config=config).slice(0, 1100)


@pytest.fixture(scope="module")
def found(drive: RobotLog) -> DriftResult:
    return correct_drift(drive)


def pose_at(result: DriftResult, t: float) -> FloatArray:
    return result.trajectory.poses[int(np.abs(result.trajectory.t - t).argmin())]


def mean_error(poses: FloatArray, log: RobotLog) -> float:
    assert log.truth is not None
    return float(np.hypot(*(poses - log.truth)[:, :2].T).mean())


def again(log: RobotLog) -> tuple[float, float]:
    """Two times at which the robot was at truly the same place, as far apart as there are."""
    assert log.truth is not None
    at = np.arange(0, len(log), 5)
    apart = np.hypot(*(log.truth[at, None, :2] - log.truth[None, at, :2]).transpose(2, 0, 1))
    turned = np.abs(wrap_angle(log.truth[at, None, 2] - log.truth[None, at, 2]))
    lag = np.where((apart < 0.3) & (turned < 0.5), at[None, :] - at[:, None], -1)
    first, second = np.unravel_index(int(lag.argmax()), lag.shape)
    return float(log.t[at[first]]), float(log.t[at[second]])


def test_ids_name_each_closure_once(found: DriftResult) -> None:
    ids = [closure.id for closure in found.closures]

    assert len(set(ids)) == len(ids) > 0
    assert all(CLOSURE_ID.fullmatch(closure_id) for closure_id in ids)


def test_a_rejected_closure_does_not_count_but_is_still_told(
    drive: RobotLog, found: DriftResult
) -> None:
    wrong = next(closure.id for closure in found.closures if closure.accepted)

    result = correct_drift(drive, edits=DriftEdits(rejected=(wrong,)))

    told = next(closure for closure in result.closures if closure.id == wrong)
    assert (told.accepted, told.by_person) == (False, True)
    assert (result.trajectory.poses != found.trajectory.poses).any()


def test_rejecting_every_closure_is_having_none(drive: RobotLog, found: DriftResult) -> None:
    blind = correct_drift(drive, BLIND)
    ids = tuple(closure.id for closure in (*found.closures, *blind.closures))

    result = correct_drift(drive, edits=DriftEdits(rejected=ids))

    assert not any(closure.accepted for closure in result.closures)


def test_an_accepted_closure_counts_although_the_program_rejected_it(drive: RobotLog) -> None:
    blind = correct_drift(drive, BLIND)
    right = max(blind.closures, key=lambda closure: closure.score)

    result = correct_drift(drive, BLIND, edits=DriftEdits(accepted=(right.id,)))

    told = [closure for closure in result.closures if closure.id == right.id]
    assert [(closure.accepted, closure.by_person) for closure in told] == [(True, True)]
    relative = between(pose_at(result, right.t_source), pose_at(result, right.t_target))
    assert relative[:2] == pytest.approx(right.pose[:2], abs=0.15)


def test_two_places_called_the_same_are_brought_together(drive: RobotLog) -> None:
    early, late = again(drive)
    blind = correct_drift(drive, BLIND)

    result = correct_drift(drive, BLIND, edits=DriftEdits(same_places=(SamePlace(late, early),)))

    def gap(of: DriftResult) -> float:
        return float(np.hypot(*(pose_at(of, early) - pose_at(of, late))[:2]))

    assert gap(result) < 0.5
    assert sum(closure.accepted for closure in result.closures) == 1
    assert mean_error(result.trajectory.poses, drive) <= mean_error(blind.trajectory.poses, drive)


def test_a_dragged_stretch_lies_where_it_was_put(drive: RobotLog, found: DriftResult) -> None:
    t = float(drive.t[700])
    x, y, heading = pose_at(found, t) + np.array([0.6, -0.4, 0.1])

    result = correct_drift(drive, edits=DriftEdits(dragged=(Dragged(t, x, y, heading),)))

    there = pose_at(result, t)
    assert np.hypot(there[0] - x, there[1] - y) < 0.25
    assert result.trajectory.poses[0] == pytest.approx(drive.odometry[0], abs=1e-6)


def test_the_same_words_give_the_same_trajectory(drive: RobotLog) -> None:
    part = drive.slice(0, 500)
    edits = DriftEdits(dragged=(Dragged(float(part.t[300]), 5.0, 7.0),))

    first, second = correct_drift(part, edits=edits), correct_drift(part, edits=edits)

    assert (first.trajectory.poses == second.trajectory.poses).all()


@pytest.mark.parametrize(
    ("edits", "says"),
    [
        (DriftEdits(dragged=(Dragged(1e6, 0.0, 0.0),)), "outside of the drive"),
        (DriftEdits(dragged=(Dragged(0.0, 0.0, 0.0),)), "start of the drive"),
        (DriftEdits(same_places=(SamePlace(5.0, 5.1),)), "same place of the drive already"),
        (DriftEdits(accepted=("nonsense",)), "no id of a closure"),
    ],
)
def test_what_cannot_be_is_refused(drive: RobotLog, edits: DriftEdits, says: str) -> None:
    with pytest.raises(InputError, match=says):
        correct_drift(replace(drive, t=drive.t - drive.t[0]).slice(0, 300), edits=edits)


def test_one_thing_that_was_said_is_taken_back_whatever_was_said_since() -> None:
    door, hall = SamePlace(1.0, 50.0), SamePlace(2.0, 60.0)
    said = DriftEdits().calling_same(door).dragging(Dragged(30.0, 1.0, 2.0)).calling_same(hall)

    assert said.parting(door) == DriftEdits(same_places=(hall,), dragged=said.dragged)
    assert said.releasing(30.0) == DriftEdits(same_places=(door, hall))


def test_what_nobody_said_cannot_be_taken_back() -> None:
    with pytest.raises(InputError, match="1 s and 50 s the same"):
        DriftEdits().parting(SamePlace(1.0, 50.0))
    with pytest.raises(InputError, match="dragged the drive at 30 s"):
        DriftEdits().releasing(30.0)
