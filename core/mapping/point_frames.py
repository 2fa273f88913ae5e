"""Reflecting points in the frame of a pose, and in the world."""

from __future__ import annotations

import numpy as np

from core.geometry import FloatArray, compose, inverse
from core.mapping.reflection_points import ReflectionPoints


def points_of_stretch(
    points: ReflectionPoints, length: FloatArray, start: float, stop: float
) -> slice:
    """Which points were seen between `start` and `stop` metres of travel (`length`: (N,) at scans)."""
    at = length[points.scan]
    return slice(int(np.searchsorted(at, start)), int(np.searchsorted(at, stop)))


def points_from(
    points: ReflectionPoints, poses: FloatArray, anchor: int, part: slice
) -> tuple[FloatArray, FloatArray]:
    """The points `part` (M, 2) and their unit views (M, 2) in the frame of the scan `anchor`."""
    local = compose(inverse(poses[anchor]), poses[points.scan[part]])
    seen = transform_each(local, points.point[part])
    return seen, unit(seen - transform_each(local, points.sonar[part]))


def points_in_world(points: ReflectionPoints, poses: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Reflecting points (M, 2) and unit view directions (M, 2) in the frame of the poses (N, 3)."""
    at = poses[points.scan]
    seen = transform_each(at, points.point)
    return seen, unit(seen - transform_each(at, points.sonar))


def transform_each(poses: FloatArray, points: FloatArray) -> FloatArray:
    """Points (M, 2), each of the frame of its own pose (M, 3), in the frame of the poses."""
    c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    x, y = points[:, 0], points[:, 1]
    return np.stack((poses[:, 0] + c * x - s * y, poses[:, 1] + s * x + c * y), axis=1)


def unit(vectors: FloatArray) -> FloatArray:
    """Vectors (M, 2) of length 1; zero stays zero."""
    return np.asarray(vectors / np.maximum(np.hypot(vectors[:, 0], vectors[:, 1]), 1e-9)[:, None])
