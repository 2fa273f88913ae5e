from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from core.log_readers.pose_join import poses_at


def test_times_of_poses_give_those_poses() -> None:
    rng = np.random.default_rng(0)
    t = np.cumsum(rng.uniform(0.1, 0.4, 50))
    poses = np.cumsum(rng.normal(0, 0.1, (50, 3)), axis=0)
    out, known = poses_at(t, t, poses)
    np.testing.assert_allclose(out, poses, rtol=1e-12)
    assert known.all()


def test_one_pose_serves_what_is_near_it() -> None:
    out, known = poses_at(np.array([0.4, 0.6, 1.6]), np.array([1.0]), np.array([[1.0, 2.0, 3.0]]))
    assert known.tolist() == [False, True, False]
    assert out[1].tolist() == [1, 2, 3]


@settings(max_examples=50, deadline=None)
@given(st.floats(0, 9), st.integers(0, 2**16))
def test_a_pose_between_two_lies_between_them(time: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    poses = rng.uniform(-1, 1, (10, 3))
    out, known = poses_at(np.array([time]), np.arange(10.0), poses)
    left = min(int(time), 8)
    low, high = np.sort(poses[left : left + 2], axis=0)
    assert known[0]
    assert (out[0] >= low - 1e-12).all()
    assert (out[0] <= high + 1e-12).all()
