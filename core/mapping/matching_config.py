"""Parameters of submaps and of their matching."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class MatchingConfig:
    """Parameters of the correlative matching.

    Attributes:
        cell: lattice of positions and cell of the density (m).
        turn_step: lattice of headings (rad).
        smoothing: standard deviation of the density's smoothing (m).
        full_density: the density that counts as 1, in units of the submap's typical density (its mean
            over its own points).
        free_penalty: what a point in the other submap's free space costs.
        free_rays: rays that must cross a cell to call it free.
        ray_end: a ray ends this far in front of its point (m).
        point_cell, point_cap: points are thinned to one a cell (m) with a weight of at most the cap.
        same_side: share of the agreement that does not depend on the direction of view: 0 makes the
            two faces of a wall repel each other, 0.5 makes them indifferent.
        margin: density is kept this far around the points (m).
        sharpness: a pose is exp(sharpness (score - best)) times as likely as the best one.
        likely: less likely ones do not count for the covariance.
        position_floor, heading_floor: standard deviation (m, rad) of even the best match.
        peak_exclusion: lattice steps around the best pose that do not count as a second best one.
    """

    cell: float = 0.1
    turn_step: float = math.radians(2.0)
    smoothing: float = 0.09
    full_density: float = 2.0
    free_penalty: float = 0.5
    free_rays: int = 2
    ray_end: float = 0.2
    point_cell: float = 0.05
    point_cap: int = 4
    same_side: float = 0.5
    margin: float = 1.5
    sharpness: float = 40.0
    likely: float = 0.01
    position_floor: float = 0.06
    heading_floor: float = math.radians(1.3)
    peak_exclusion: int = 3
