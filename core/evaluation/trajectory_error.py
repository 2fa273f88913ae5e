"""How far a trajectory is from the true one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray, compose, rigid_fit, wrap_angle


@dataclass(frozen=True)
class TrajectoryError:
    """Errors of a trajectory: metres and radians.

    Attributes:
        mean, median, rmse, largest: of the position, over all poses.
        at_end: of the last position.
        heading_mean: mean absolute error of the heading.
        heading_at_end: signed error of the last heading.
    """

    mean: float
    median: float
    rmse: float
    largest: float
    at_end: float
    heading_mean: float
    heading_at_end: float


def trajectory_error(poses: FloatArray, truth: FloatArray, fitted: bool = False) -> TrajectoryError:
    """Compares poses (N, 3) with the true ones (N, 3), pose by pose.

    Args:
        poses: the trajectory.
        truth: the true poses at the same times.
        fitted: lay the trajectory on the truth by one rigid motion first, so that only its bending
            counts (absolute trajectory error; Sturm et al. 2012). Otherwise both start in the same
            frame and all of the drift counts.
    """
    if fitted:
        poses = compose(rigid_fit(truth[:, :2], poses[:, :2]), poses)
    off = np.hypot(*(poses - truth)[:, :2].T)
    turned = wrap_angle(poses[:, 2] - truth[:, 2])
    return TrajectoryError(
        mean=float(off.mean()),
        median=float(np.median(off)),
        rmse=float(np.sqrt((off**2).mean())),
        largest=float(off.max()),
        at_end=float(off[-1]),
        heading_mean=float(np.abs(turned).mean()),
        heading_at_end=float(turned[-1]),
    )
