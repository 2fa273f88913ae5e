"""Effective distance and effective angle: the paper's motion model over candidates (eq. 18-20)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray, wrap_angle


@dataclass(frozen=True)
class EffectiveMotionConfig:
    """sigma_d and sigma_a of eq. (18) and (20); the paper's values (Sect. 5.2)."""

    sigma_distance: float = 0.5
    sigma_angle: float = math.radians(15)


def normal_density(value: FloatArray, mean: float, sigma: float) -> FloatArray:
    """N(.; mean, sigma^2) at the values."""
    z = (value - mean) / sigma
    return np.asarray(np.exp(-0.5 * z * z) / (sigma * math.sqrt(2 * math.pi)))


def effective_distances(before: FloatArray, now: FloatArray) -> FloatArray:
    """d_ij between candidates (n, 2) of node j before and node i now: (n, n), `[i, j]`."""
    return np.asarray(np.linalg.norm(now[:, None] - before[None, :], axis=-1))


def effective_angles(earlier: FloatArray, before: FloatArray, now: FloatArray) -> FloatArray:
    """a_ijk between the way from k (earlier) to j (before) and from j to i (now): (n, n, n).

    The direction of the effective distance before is the reference (4.3.3).
    """
    way = before[:, None] - earlier[None, :]  # [j, k]
    onward = now[:, None] - before[None, :]  # [i, j]
    turned = np.arctan2(onward[..., 1], onward[..., 0])[:, :, None]
    return wrap_angle(turned - np.arctan2(way[..., 1], way[..., 0])[None])


def distance_transition(
    before: FloatArray, now: FloatArray, predicted: float, config: EffectiveMotionConfig
) -> FloatArray:
    """P(N_t = i | N_t-1 = j, ED_t) of eq. (18): (n, n), `[i, j]`."""
    return normal_density(effective_distances(before, now), predicted, config.sigma_distance)


def angle_transition(
    earlier: FloatArray,
    before: FloatArray,
    now: FloatArray,
    predicted: float,
    came_from: FloatArray,
    config: EffectiveMotionConfig,
) -> FloatArray:
    """The sum over k of eq. (19): (n, n), `[i, j]`.

    Args:
        earlier, before, now: candidates (n, 2) at t - 2, t - 1 and t.
        predicted: the effective angle from odometry, radians.
        came_from: P(N_t-2 = k | N_t-1 = j), (n, n), `[k, j]`.
        config: sigma_a.
    """
    off = wrap_angle(effective_angles(earlier, before, now) - predicted)
    density = normal_density(off, 0.0, config.sigma_angle)  # eq. (20), angles are cyclic
    return np.asarray(np.einsum("ijk,kj->ij", density, came_from))


def came_from(transition: FloatArray, earlier: FloatArray) -> FloatArray:
    """P(N_t-2 = k | N_t-1 = j) by Bayes from `transition` `[j, k]` and P(N_t-2) (n,): `[k, j]`."""
    joint = transition * earlier[None, :]
    total = joint.sum(axis=1, keepdims=True)
    n = len(earlier)
    return np.asarray(np.where(total > 0, joint / np.maximum(total, 1e-300), 1 / n).T)
