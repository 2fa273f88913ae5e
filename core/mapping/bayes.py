"""Bayesian log-odds mapping (Moravec and Elfes 1985): the baseline that CEMAL is compared with."""

from __future__ import annotations

from dataclasses import dataclass

import numba
import numpy as np

from core.mapping.beam_footprint import (
    BeamFootprints,
    beam_capacity,
    cells_of_beam,
    frame_of,
    grid_around,
    readings_of,
)
from core.mapping.empty_evidence import empty_evidence
from core.mapping.map_result import MapResult, check_size, cropped
from core.mapping.occupancy_grid import DEFAULT_RESOLUTION, OccupancyGrid
from core.mapping.robot_footprint import driven_over
from core.progress import Progress, no_progress
from core.sensing import RobotLog, Trajectory


@dataclass(frozen=True)
class BayesConfig:
    """Parameters of the log-odds map.

    Attributes:
        resolution: metres per cell.
        log_odds_empty: evidence of one reading on the beam's axis for a cell before its echo.
        log_odds_occupied: evidence of one reading on the axis for a cell at its echo.
        trusted_range: metres; beyond, a longer reading frees less, as it is more often specular.
        limit: log-odds are held within this bound, so that a change can be learned.
        free_clearance, arc_half_thickness: metres, as in CEMAL.
        free_below, occupied_above: log-odds beyond which a cell counts as free or occupied.
    """

    resolution: float = DEFAULT_RESOLUTION
    log_odds_empty: float = -0.6
    log_odds_occupied: float = 0.4
    trusted_range: float = 1.0
    limit: float = 12.0
    free_clearance: float = 0.06
    arc_half_thickness: float = 0.05
    free_below: float = -1.5
    occupied_above: float = 0.6


def bayes_map(
    log: RobotLog,
    trajectory: Trajectory,
    config: BayesConfig | None = None,
    progress: Progress = no_progress,
) -> MapResult:
    """The log-odds map of a drive; all readings are kept.

    The inverse sensor model is the directivity of eq. (4): a beam says most on its axis, and least
    for empty cells close to its echo (Elfes 1989). Confidence is the log-odds of the occupied cells.

    Args:
        log: scans; its odometry is not looked at.
        trajectory: one pose per scan.
        config: parameters.
        progress: told at the start and the end.

    Raises:
        MapError: the drive is too large for a grid.
    """
    config = config or BayesConfig()
    readings = readings_of(log, trajectory)
    geometry = grid_around(log, trajectory, readings, config.resolution)
    check_size(geometry)
    progress(0.0, "adding evidence")
    footprints = BeamFootprints.of(log.ring)
    frame, shape = frame_of(geometry)
    reach = float(readings.range_m.max(initial=0.0)) + config.arc_half_thickness
    capacity = beam_capacity(reach, float(footprints.half_beam.max()), config.resolution)
    model = np.array(
        [
            config.log_odds_empty,
            config.log_odds_occupied,
            config.limit,
            config.free_clearance,
            config.arc_half_thickness,
            config.trusted_range,
        ]
    )
    beams = (
        readings.pose,
        readings.range_m,
        readings.sonar,
        footprints.half_beam,
        footprints.gain,
        frame,
        shape,
        capacity,
    )
    log_odds = _log_odds(*beams, model).reshape(geometry.shape)
    _, count = empty_evidence(np.ones(len(readings), bool), config.free_clearance, *beams)
    occupied = log_odds > config.occupied_above
    free = (log_odds < config.free_below) | driven_over(
        geometry, trajectory.poses, log.ring.robot_radius
    )
    kept = np.zeros(log.ranges.shape, bool)
    kept[readings.scan, readings.sonar] = True
    progress(1.0, "adding evidence")
    grid = OccupancyGrid.of(geometry, free, occupied & ~free)
    confidence = np.where(grid.occupied, log_odds, 0.0)
    return cropped(MapResult(grid, confidence, kept, count.reshape(geometry.shape)))


@numba.njit(cache=True)
def _log_odds(pose, ranges, sonar, half, gain, frame, shape, capacity, model):  # type: ignore[no-untyped-def]
    """Log-odds of all cells (flat) after all readings; `model` holds the six numbers above."""
    empty, full, limit, clearance, thickness, trusted = model
    odds = np.zeros(shape[0] * shape[1])
    cells = np.empty(capacity, np.int64)
    distance, pressure = np.empty(capacity), np.empty(capacity)
    for i in range(len(ranges)):
        s = sonar[i]
        n = cells_of_beam(
            pose[i],
            ranges[i] + thickness,
            half[s],
            gain[s],
            frame,
            shape,
            cells,
            distance,
            pressure,
        )
        for k in range(n):
            weight = pressure[k] * max(distance[k], 0.1) ** 2
            if distance[k] < ranges[i] - clearance:
                change = (
                    empty * weight * (1 - distance[k] / ranges[i]) * min(1.0, trusted / ranges[i])
                )
            elif distance[k] >= ranges[i] - thickness:
                change = full * weight
            else:
                continue
            odds[cells[k]] = min(limit, max(-limit, odds[cells[k]] + change))
    return odds
