from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.geometry import (
    between,
    compose,
    inverse,
    rigid_fit,
    transform_points,
    travelled,
    wrap_angle,
)

number = st.floats(-50, 50)
pose = st.tuples(number, number, st.floats(-10, 10)).map(np.array)


def same(a: np.ndarray, b: np.ndarray) -> bool:
    difference = np.asarray(a) - np.asarray(b)
    difference[..., 2] = wrap_angle(difference[..., 2])
    return bool(np.allclose(difference, 0, atol=1e-8))


@given(pose)
def test_a_pose_and_its_inverse_cancel(p: np.ndarray) -> None:
    assert same(compose(p, inverse(p)), np.zeros(3))


@given(pose, pose, pose)
def test_composition_is_associative(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> None:
    assert same(compose(compose(a, b), c), compose(a, compose(b, c)))


@given(pose, pose)
def test_the_motion_between_two_poses_leads_from_one_to_the_other(
    a: np.ndarray, b: np.ndarray
) -> None:
    assert same(compose(a, between(a, b)), [b[0], b[1], wrap_angle(b[2])])


@given(st.floats(-1e3, 1e3))
def test_wrapped_angles_lie_in_the_half_open_circle(angle: float) -> None:
    assert -np.pi <= wrap_angle(angle) < np.pi


def test_a_quarter_turn_moves_a_point_from_the_front_to_the_left() -> None:
    np.testing.assert_allclose(
        transform_points([1.0, 2.0, np.pi / 2], [[3.0, 0.0]]), [[1.0, 5.0]], atol=1e-12
    )


def test_distance_travelled_adds_up_the_steps() -> None:
    np.testing.assert_allclose(travelled(np.array([[0, 0, 0], [3, 4, 1], [3, 5, 2.0]])), [0, 5, 6])


@given(pose)
def test_a_rigid_fit_finds_the_pose_that_moved_the_points(p: np.ndarray) -> None:
    points = np.array([[0, 0], [1, 0], [0, 2], [3, 1.0]])
    assert same(rigid_fit(transform_points(p, points), points), [p[0], p[1], wrap_angle(p[2])])
