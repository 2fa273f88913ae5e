"""What odometry does to a pose belief: it moves it, and blurs it by what odometry does not know.

Robots are also carried, and leave the map: a little of the belief goes everywhere and to `unknown`
at every step, so that no place is ever given up for good.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np
from scipy import ndimage

from core.localization.pose_grid import MassArray, PoseBelief, PoseGrid

NEGLIGIBLE = 1e-11
"""Mass of a pose that is not worth moving."""
BLUR_REACH = 3.0
"""Standard deviations after which the blur is cut off."""


@dataclass(frozen=True)
class PoseMotionConfig:
    """How far odometry is trusted and how often robots are carried.

    The odometry terms cover calibrated and bad odometry alike (a systematic turn or drift is just
    an error that points the same way every time). Chosen on simulated homes.

    Attributes:
        distance_share: standard deviation of the distance, per metre.
        per_root_metre: random error, metres per square root of a metre driven.
        turn_share: standard deviation of a turn, per radian turned.
        turn_per_root_metre: random error of the heading, radians per square root of a metre.
        turn_per_metre: systematic drift of the heading, radians per metre.
        kidnapped: chance per step to be put anywhere in the map.
        leaves: chance per step to leave the map.
        enters: chance per step to come back from outside, anywhere.
        off_ground: weight of mass that motion puts where nobody can stand.
    """

    distance_share: float = 0.025
    per_root_metre: float = 0.03
    turn_share: float = 0.02
    turn_per_root_metre: float = math.radians(1.2)
    turn_per_metre: float = math.radians(0.3)
    kidnapped: float = 1e-3
    leaves: float = 1e-3
    enters: float = 0.02
    off_ground: float = 0.0


def predict(
    belief: PoseBelief,
    grid: PoseGrid,
    motion: tuple[float, float, float],
    distance: float,
    turned: float,
    config: PoseMotionConfig,
) -> PoseBelief:
    """The belief after a motion, before any reading of it.

    Args:
        belief: before the motion.
        grid: its poses.
        motion: odometry `(x, y, heading)` in the frame of the pose before.
        distance: metres driven.
        turned: radians turned, whatever the direction.
        config: noise and chances.
    """
    spread_xy = math.hypot(config.distance_share * distance, config.per_root_metre * distance**0.5)
    spread_turn = math.hypot(
        math.hypot(config.turn_share * turned, config.turn_per_metre * distance),
        config.turn_per_root_metre * distance**0.5,
    )
    moved = _shift(belief.mass, grid.geometry.resolution, *motion)
    moved = _blur(moved, spread_turn / grid.heading_step, spread_xy / grid.geometry.resolution)
    moved *= np.where(grid.standable, 1.0, config.off_ground).astype(np.float32)
    mapped = 1.0 - belief.unknown
    total = float(moved.sum(dtype=np.float64))
    stays = mapped * (1 - config.leaves)
    kidnapped = config.kidnapped if total > 0 else 1.0
    if total > 0:
        moved *= np.float32(stays * (1 - kidnapped) / total)
    anywhere = stays * kidnapped + belief.unknown * config.enters
    moved += (grid.standable * (anywhere / max(grid.poses, 1))).astype(np.float32)
    unknown = belief.unknown * (1 - config.enters) + mapped * config.leaves
    return PoseBelief(moved, unknown if grid.poses else 1.0)


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _shift(mass: MassArray, cell: float, dx: float, dy: float, turn: float) -> MassArray:
    """Moves every pose by a motion in its own frame, split over the 8 nearest poses."""
    headings, rows, cols = mass.shape
    out = np.zeros_like(mass)
    step = 2 * math.pi / headings
    whole = math.floor(turn / step)
    rest = turn / step - whole
    for h in range(headings):
        cos, sin = math.cos(h * step), math.sin(h * step)
        col_shift, row_shift = (cos * dx - sin * dy) / cell, (sin * dx + cos * dy) / cell
        dc, dr = math.floor(col_shift), math.floor(row_shift)
        fc, fr = col_shift - dc, row_shift - dr
        first = (h + whole) % headings
        for r in range(max(0, -dr - 1), min(rows, rows - dr)):
            for c in range(max(0, -dc - 1), min(cols, cols - dc)):
                value = mass[h, r, c]
                if value < NEGLIGIBLE:
                    continue
                for i in range(2):
                    row = r + dr + i
                    if row < 0 or row >= rows:
                        continue
                    for j in range(2):
                        col = c + dc + j
                        if col < 0 or col >= cols:
                            continue
                        part = value * (fr if i else 1 - fr) * (fc if j else 1 - fc)
                        out[first, row, col] += part * (1 - rest)
                        out[(first + 1) % headings, row, col] += part * rest
    return out


def _blur(mass: MassArray, turn_sigma: float, cell_sigma: float) -> MassArray:
    """Gaussian blur over headings and cells, only where there is mass."""
    margin = math.ceil(BLUR_REACH * cell_sigma) + 1
    rows = np.flatnonzero(mass.max(axis=(0, 2)))
    cols = np.flatnonzero(mass.max(axis=(0, 1)))
    if len(rows) == 0:
        return mass
    part = (
        slice(None),
        slice(max(0, rows[0] - margin), rows[-1] + 1 + margin),
        slice(max(0, cols[0] - margin), cols[-1] + 1 + margin),
    )
    mass[part] = ndimage.gaussian_filter(
        mass[part],
        (turn_sigma, cell_sigma, cell_sigma),
        mode=("wrap", "constant", "constant"),
        truncate=BLUR_REACH,
    )
    return mass
