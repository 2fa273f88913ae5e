"""In which direction the walls around the robot run.

Walls of a building meet at right angles nearly everywhere (the Manhattan assumption of Coughlan and
Yuille 1999). Projected on the right two axes, the reflecting points of a stretch pile up into sharp
peaks, each wall one; the direction of the sharpest projection is that of the walls, modulo 90 degrees.
It pins the heading without any closure, and so makes drift bounded even along a corridor.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np

from core.geometry import FloatArray

QUARTER_TURN = math.pi / 2


@dataclass(frozen=True)
class WallDirectionConfig:
    """Parameters of the projection.

    Attributes:
        step: angles tried (rad).
        bin_width: of the projections (m).
        smoothing: standard deviation of the projections' smoothing (m).
        facing: power of the cosine between view and axis with which a point counts for a wall across
            that axis.
        distinct: angles at least this far off (rad) compete with the best one.
        max_ambiguity: the sharpness there may be at most this share of the best one.
        thinning: one point is used for each cell of this side (m), so that an echo from a corner that
            many scans repeat does not outweigh a wall that each scan sees elsewhere.
        min_points: fewer tell nothing.
    """

    step: float = math.radians(0.5)
    bin_width: float = 0.05
    smoothing: float = 0.05
    facing: int = 4
    distinct: float = math.radians(10)
    max_ambiguity: float = 0.7
    thinning: float = 0.1
    min_points: int = 20


def wrap_quarter(angle: FloatArray | float) -> FloatArray:
    """Angles brought into [-45, 45) degrees by quarter turns."""
    return np.asarray((np.asarray(angle, float) + math.pi / 4) % QUARTER_TURN - math.pi / 4)


def wall_direction(
    points: FloatArray, views: FloatArray, config: WallDirectionConfig | None = None
) -> float | None:
    """Direction of the walls in [-45, 45) degrees (as rad), or None where there is no clear one.

    Args:
        points: (M, 2) reflecting points in any one frame, metres.
        views: (M, 2) unit vectors from the sonar to the point in that frame.
        config: parameters.
    """
    config = config or WallDirectionConfig()
    angles = np.arange(-math.pi / 4, math.pi / 4, config.step)
    found = _sharpness(points, views, angles, config)
    if found is None:
        return None
    sharpness, _ = found
    best = int(sharpness.argmax())
    far = np.abs(wrap_quarter(angles - angles[best])) >= config.distinct
    if sharpness[far].max() > config.max_ambiguity * sharpness[best]:
        return None
    low, high = sharpness[best - 1], sharpness[(best + 1) % len(angles)]
    bend = low - 2 * sharpness[best] + high
    shift = 0.5 * (low - high) / bend if bend < 0 else 0.0
    return float(wrap_quarter(angles[best] + shift * config.step))


def wall_sharpness(
    points: FloatArray, views: FloatArray, config: WallDirectionConfig | None = None
) -> float:
    """How well all points of a drive lie on walls at right angles, per point; 0 without points.

    Args:
        points: (M, 2) reflecting points, metres.
        views: (M, 2) unit vectors from the sonar to the point.
        config: parameters.
    """
    config = config or WallDirectionConfig()
    angles = np.arange(-math.pi / 4, math.pi / 4, config.step)
    found = _sharpness(points, views, angles, config)
    return 0.0 if found is None else float(found[0].max() / found[1])


def _sharpness(
    points: FloatArray, views: FloatArray, angles: FloatArray, config: WallDirectionConfig
) -> tuple[FloatArray, int] | None:
    """Sharpness of the projections at each angle, and the number of points that count."""
    cells = np.floor(points / config.thinning).astype(np.int64)
    _, kept = np.unique(cells, axis=0, return_index=True)
    if len(kept) < config.min_points:
        return None
    centred = points[kept] - points[kept].mean(axis=0)
    bins = 2 * math.ceil(float(np.hypot(*centred.T).max()) / config.bin_width) + 5
    reach = math.ceil(3 * config.smoothing / config.bin_width)
    offset = np.arange(-reach, reach + 1) * config.bin_width / config.smoothing
    kernel = np.exp(-0.5 * offset**2)
    sharpness = _projection_sharpness(
        centred, views[kept], angles, config.bin_width, config.facing, bins, kernel
    )
    return np.asarray(sharpness), len(kept)


@numba.njit(cache=True)
def _projection_sharpness(points, views, angles, bin_width, facing, bins, kernel):  # type: ignore[no-untyped-def]
    """(A,) sum of the squared, smoothed histograms of the points along both axes, for each angle.

    The two sides a wall is seen from are kept apart.
    """
    out = np.zeros(len(angles))
    reach = len(kernel) // 2
    for a in range(len(angles)):
        c, s = math.cos(angles[a]), math.sin(angles[a])
        count = np.zeros((4, bins + 2 * reach))
        for k in range(len(points)):
            for axis in range(2):
                ux, uy = (c, s) if axis == 0 else (-s, c)
                facing_it = ux * views[k, 0] + uy * views[k, 1]
                where = (ux * points[k, 0] + uy * points[k, 1]) / bin_width + bins // 2
                side = 2 * axis + (1 if facing_it < 0 else 0)
                count[side, int(where) + reach] += abs(facing_it) ** facing
        for side in range(4):
            for i in range(bins):
                smooth = 0.0
                for j in range(len(kernel)):
                    smooth += kernel[j] * count[side, i + j]
                out[a] += smooth * smooth
    return out
