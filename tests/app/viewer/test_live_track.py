"""What a live session has told can be drawn now or as it was."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.viewer.live_track import LiveTrack
from core.sensing.ring import RING_PRESETS

RING = RING_PRESETS["circle-8"]
SILENT: list[float | None] = [None] * 8


def driven(localizes: bool, scans: int = 5) -> LiveTrack:
    """A robot that believes to drive 0.1 m along x every second."""
    track = LiveTrack(RING, localizes)
    for i in range(scans):
        track.add(float(i), [0.1 * i, 0.0, 0.0], SILENT)
    return track


def belief(t: float, pose: list[float]) -> dict[str, object]:
    return {"t": t, "pose": pose, "probabilities": {"a": 0.75}, "unknown": 0.25, "entropy": 0.5}


def test_a_mapping_robot_is_where_its_odometry_says():
    track = driven(localizes=False)
    assert track.pose(3).tolist() == pytest.approx([0.3, 0.0, 0.0])
    assert track.path(3)[-1, 1].tolist() == pytest.approx([0.3, 0.0])


def test_a_robot_that_is_looked_for_is_nowhere_until_it_is_believed_to_be_somewhere():
    track = driven(localizes=True)
    assert track.pose(4) is None
    assert track.belief(4) is None
    assert len(track.path(4)) == 0


def test_a_belief_moves_on_with_the_odometry_and_turns_it():
    track = driven(localizes=True)
    track.believe(belief(2.0, [5.0, 5.0, math.pi / 2]))
    track.add(5.0, [0.5, 0.0, 0.0], SILENT)
    assert track.pose(1) is None
    assert track.pose(2).tolist() == pytest.approx([5.0, 5.0, math.pi / 2])
    assert track.pose(5).tolist() == pytest.approx([5.0, 5.3, math.pi / 2])
    assert track.belief(5).pose == pytest.approx((5.0, 5.3, math.pi / 2))
    assert track.belief(5).probabilities == {"a": 0.75}


def test_the_way_does_not_cross_the_home_when_the_robot_is_found_elsewhere():
    track = driven(localizes=True)
    track.believe(belief(0.0, [0.0, 0.0, 0.0]))
    track.believe(belief(3.0, [9.0, 9.0, 0.0]))
    lengths = np.hypot(*(track.path(4)[:, 1] - track.path(4)[:, 0]).T)
    assert lengths.max() < 0.2
    assert lengths.sum() == pytest.approx(0.3)


def test_looking_back_gives_the_moment_and_the_way_until_then():
    track = driven(localizes=False)
    assert track.index_at(None) == 4
    assert track.index_at(2.6) == 2
    assert track.index_at(-1.0) == 0
    assert track.path(2)[:, 1].max() == pytest.approx(0.2)


def test_what_is_told_twice_is_kept_once():
    track = driven(localizes=False)
    track.add(4.0, [9.0, 9.0, 0.0], SILENT)
    assert len(track) == 5


def test_a_mapping_robot_is_drawn_where_drift_correction_puts_it_from_then_on() -> None:
    track = LiveTrack(RING, localizes=False)
    for i in range(4):
        track.add(float(i), [float(i), 0.0, 0.0], SILENT)
    track.correct(2.0, [0.0, 0.5, 0.0])
    assert [track.pose(i).tolist() for i in (1, 2, 3)] == [[1, 0, 0], [2, 0.5, 0], [3, 0.5, 0]]
    track.add(4.0, [4.0, 0.0, 0.0], SILENT)
    assert track.pose(4).tolist() == [4, 0.5, 0]
