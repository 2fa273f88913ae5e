"""How much of what the robot heard a place explains: the score of a candidate, for people to read."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.geometry import BoolArray, FloatArray, transform_points
from core.localization.expected_range import NOTHING, RANGE_STEP
from core.localization.pose_grid import PoseGrid
from core.localization.pose_observation import SonarTables
from core.localization.segment import Segment
from core.localization.sonar_likelihood import NO_ECHO


@dataclass(frozen=True)
class FitConfig:
    """When an echo counts as explained: this close to the expected range (m, plus a share of it)."""

    tolerance: float = 0.15
    tolerance_per_m: float = 0.05


def share_explained(
    segment: Segment,
    poses: FloatArray,
    kinds: tuple[SonarTables, ...],
    kind_of_sonar: np.ndarray,
    grid: PoseGrid,
    config: FitConfig,
) -> FloatArray:
    """The share of echoes explained at each pose (n, 3) of the map: (n,); 0 for NaN poses."""
    heard = segment.codes != NO_ECHO
    out = np.zeros(len(poses))
    if not heard.any():
        return out
    for i, pose in enumerate(poses):
        if np.isfinite(pose).all():
            out[i] = _explained(segment, heard, pose, kinds, kind_of_sonar, grid, config).mean()
    return out


def _explained(
    segment: Segment,
    heard: BoolArray,
    pose: FloatArray,
    kinds: tuple[SonarTables, ...],
    kind_of_sonar: np.ndarray,
    grid: PoseGrid,
    config: FitConfig,
) -> BoolArray:
    """Which echoes are explained at a pose: (K,)."""
    points = np.stack((segment.x[heard], segment.y[heard]), axis=-1)
    cells = grid.geometry.cell_of(transform_points(pose, points))
    inside = grid.geometry.contains(cells)
    rows, cols = np.where(inside[:, None], cells, 0).T
    angle = pose[2] - grid.geometry.origin[2] + segment.heading[heard]
    kind = kind_of_sonar[segment.sonar[heard]]
    allowed = config.tolerance + config.tolerance_per_m * segment.ranges[heard]
    explained = np.zeros(len(rows), bool)
    for k, sonar in enumerate(kinds):
        directions = sonar.codes.shape[0]
        turn = np.round(angle / (2 * math.pi / directions)).astype(np.int64) % directions
        code = sonar.codes[turn, rows, cols] & NOTHING
        off = np.abs(code * RANGE_STEP - segment.ranges[heard][:, None])
        fits = (off <= allowed[:, None]) & (code > 0) & (code != NOTHING)
        explained |= (kind == k) & inside & fits.any(axis=1)
    return explained
