"""Planar geometry: angles and poses.

A pose is `(x, y, heading)` in metres and radians, heading counter-clockwise from +x. Many poses are
an array of shape (N, 3). `pose_a_b` is the pose of frame b in frame a.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]
AnyArray = npt.NDArray[Any]


def wrap_angle(angle: npt.ArrayLike) -> FloatArray:
    """Angles brought into [-pi, pi)."""
    return np.asarray((np.asarray(angle, float) + np.pi) % (2 * np.pi) - np.pi, float)


def compose(pose_a_b: npt.ArrayLike, pose_b_c: npt.ArrayLike) -> FloatArray:
    """`pose_a_c` of poses of shape (..., 3); the shapes broadcast."""
    a, b = np.broadcast_arrays(np.asarray(pose_a_b, float), np.asarray(pose_b_c, float))
    cos, sin = np.cos(a[..., 2]), np.sin(a[..., 2])
    out = np.empty(a.shape)
    out[..., 0] = a[..., 0] + cos * b[..., 0] - sin * b[..., 1]
    out[..., 1] = a[..., 1] + sin * b[..., 0] + cos * b[..., 1]
    out[..., 2] = wrap_angle(a[..., 2] + b[..., 2])
    return out


def inverse(pose_a_b: npt.ArrayLike) -> FloatArray:
    """`pose_b_a` of poses of shape (..., 3)."""
    a = np.asarray(pose_a_b, float)
    cos, sin = np.cos(a[..., 2]), np.sin(a[..., 2])
    out = np.empty(a.shape)
    out[..., 0] = -cos * a[..., 0] - sin * a[..., 1]
    out[..., 1] = sin * a[..., 0] - cos * a[..., 1]
    out[..., 2] = wrap_angle(-a[..., 2])
    return out


def between(pose_a_b: npt.ArrayLike, pose_a_c: npt.ArrayLike) -> FloatArray:
    """`pose_b_c`: the motion from b to c, seen from b."""
    return compose(inverse(pose_a_b), pose_a_c)


def transform_points(pose_a_b: npt.ArrayLike, points_b: npt.ArrayLike) -> FloatArray:
    """Points (N, 2) of frame b in frame a."""
    a, p = np.asarray(pose_a_b, float), np.asarray(points_b, float)
    cos, sin = np.cos(a[2]), np.sin(a[2])
    return np.stack(
        (a[0] + cos * p[..., 0] - sin * p[..., 1], a[1] + sin * p[..., 0] + cos * p[..., 1]),
        axis=-1,
    )


def travelled(poses: FloatArray) -> FloatArray:
    """Distance driven (N,) in metres at each of the poses (N, 3); 0 at the first."""
    if len(poses) == 0:
        return np.zeros(0)
    steps = np.hypot(np.diff(poses[:, 0]), np.diff(poses[:, 1]))
    return np.concatenate(([0.0], np.cumsum(steps)))


def rigid_fit(points_a: FloatArray, points_b: FloatArray) -> FloatArray:
    """`pose_a_b` that brings points_b (N, 2) closest to points_a (N, 2) in the least-squares sense.

    Reference: Umeyama (1991), without scale.
    """
    mean_a, mean_b = points_a.mean(axis=0), points_b.mean(axis=0)
    a, b = points_a - mean_a, points_b - mean_b
    heading = np.arctan2(
        (b[:, 0] * a[:, 1] - b[:, 1] * a[:, 0]).sum(), (b[:, 0] * a[:, 0] + b[:, 1] * a[:, 1]).sum()
    )
    rotated = transform_points(np.array([0.0, 0.0, heading]), mean_b[None])[0]
    return np.array([mean_a[0] - rotated[0], mean_a[1] - rotated[1], heading])
