"""Reflecting points and the matching of local maps, on the exact square room."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.geometry import between
from core.mapping.map_sharpness import map_sharpness
from core.mapping.odometry_model import without_systematic_error
from core.mapping.point_frames import points_in_world
from core.mapping.reflection_points import reflection_points
from core.mapping.scan_matching import match
from core.mapping.submap import submap
from core.sensing import RobotLog


def distance_to_walls(points: np.ndarray) -> np.ndarray:
    return np.abs(np.abs(points).max(axis=1) - 1.5)


def test_voted_points_lie_on_the_walls(square_room: RobotLog) -> None:
    points = reflection_points(square_room, square_room.odometry)
    seen, view = points_in_world(points, square_room.odometry)

    assert np.median(distance_to_walls(seen[points.strong])) < 0.03
    assert np.hypot(*view.T) == pytest.approx(np.ones(len(view)))


def test_a_repeated_value_gives_no_point(square_room: RobotLog) -> None:
    fresh = square_room.fresh.copy()
    fresh[:, 3] = False

    points = reflection_points(replace(square_room, fresh=fresh), square_room.odometry)
    everything = reflection_points(square_room, square_room.odometry)

    assert 0 < len(points) < len(everything)


def test_a_robot_that_stands_gives_each_reading_once(square_room: RobotLog) -> None:
    poses = np.repeat(square_room.odometry[:1], len(square_room), axis=0)

    points = reflection_points(replace(square_room, odometry=poses), poses)

    assert len(points) <= len(square_room.ring)


@pytest.mark.parametrize("guess", [(0.0, 0.0, 0.0), (0.25, -0.2, 0.08), (-0.3, 0.1, -0.1)])
def test_the_relative_pose_of_two_maps_of_one_room_is_found(
    square_room: RobotLog, guess: tuple[float, float, float]
) -> None:
    poses = square_room.odometry
    points = reflection_points(square_room, poses)
    half = int(np.searchsorted(points.scan, 38))
    first = submap(points, poses, 10, slice(0, half))
    second = submap(points, poses, 60, slice(half, len(points)))
    true = between(poses[10], poses[60])

    found = match(second, first, true + np.array(guess), 0.5, 0.2)

    assert found is not None
    assert np.hypot(*(found.pose - true)[:2]) < 0.08
    assert abs(found.pose[2] - true[2]) < 0.04
    assert not found.at_edge


def test_a_match_whose_true_pose_is_outside_the_search_says_so(square_room: RobotLog) -> None:
    poses = square_room.odometry
    points = reflection_points(square_room, poses)
    half = int(np.searchsorted(points.scan, 38))
    first = submap(points, poses, 10, slice(0, half))
    second = submap(points, poses, 60, slice(half, len(points)))
    guess = between(poses[10], poses[60]) + np.array([0.3, 0.0, 0.0])

    found = match(second, first, guess, 0.1, 0.04)

    assert found is not None
    assert found.at_edge


def test_true_poses_make_the_sharpest_map(square_room: RobotLog) -> None:
    points = reflection_points(square_room, square_room.odometry)
    sharp = [
        map_sharpness(
            points, without_systematic_error(square_room.odometry, np.array([0.0, turn, 0.0]))
        )
        for turn in (-0.05, 0.0, 0.05)
    ]

    assert sharp[1] > max(sharp[0], sharp[2])
