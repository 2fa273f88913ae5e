"""Poses at the times of the scans, where a log keeps both apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import BoolArray, FloatArray, wrap_angle


@dataclass(frozen=True)
class JoinConfig:
    """When a pose may be interpolated.

    Attributes:
        end_s: a scan this much before the first pose or after the last still gets that pose.
        gap_s: between poses farther apart than this ...
        gap_m, gap_rad: ... the robot must not have moved more than this.
    """

    end_s: float = 0.5
    gap_s: float = 1.0
    gap_m: float = 0.05
    gap_rad: float = 0.05


def poses_at(
    t: FloatArray, pose_t: FloatArray, poses: FloatArray, config: JoinConfig = JoinConfig()
) -> tuple[FloatArray, BoolArray]:
    """Poses (N, 3) at times (N,) and which of them are known well enough (N,).

    `poses` (M, 3) at `pose_t` (M,), increasing, M > 0. Positions are interpolated on a straight line,
    headings along the shorter arc.
    """
    right = np.clip(np.searchsorted(pose_t, t, side="right"), 1, max(len(pose_t) - 1, 1))
    right = np.minimum(right, len(pose_t) - 1)
    left = np.maximum(right - 1, 0)
    seconds = pose_t[right] - pose_t[left]
    share = np.where(seconds > 0, (t - pose_t[left]) / np.where(seconds > 0, seconds, 1.0), 0.0)
    share = np.clip(share, 0.0, 1.0)[:, None]
    step = poses[right] - poses[left]
    step[:, 2] = wrap_angle(step[:, 2])
    out = poses[left] + share * step
    moved = (np.hypot(step[:, 0], step[:, 1]) > config.gap_m) | (
        np.abs(step[:, 2]) > config.gap_rad
    )
    inside = (share[:, 0] > 0) & (share[:, 0] < 1)
    known = (t >= pose_t[0] - config.end_s) & (t <= pose_t[-1] + config.end_s)
    return out, known & ~(inside & moved & (seconds > config.gap_s))
