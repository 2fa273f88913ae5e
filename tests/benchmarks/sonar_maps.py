"""Maps that simulated sonar drives make of generated homes, with the rooms of the plans."""

from __future__ import annotations

from multiprocessing import Pool

import numpy as np
from rooms_maps import MapOfRooms

from core.evaluation.ground_truth import aligned, alignment, sampled
from core.pipeline.floor import floor_of_drive, restricted
from core.pipeline.mapper import map_log
from core.sensing import Trajectory
from core.simulation import build_home, simulate, truth_of

SONAR = "simulated_sonar"
"""The group of these maps."""
FIRST, DRIVE_SEED = 101, 5000
"""Homes below 1000 are there to choose and to fit to; from 1000 on they are reported."""


def sonar_maps(count: int, jobs: int) -> list[MapOfRooms]:
    """Maps of so many homes, made at the odometry of their drives, in so many processes."""
    with Pool(jobs) as pool:
        return pool.map(sonar_map, range(FIRST, FIRST + count), chunksize=1)


def sonar_map(number: int) -> MapOfRooms:
    """The map of one home; its true rooms are laid on it by one rigid fit of the poses."""
    home = build_home(f"random-{number}")
    log, truth = simulate(home, seed=DRIVE_SEED + number), truth_of(home)
    assert log.truth is not None
    trajectory = Trajectory.from_odometry(log)
    result = map_log(log.without_truth(), trajectory)
    grid = restricted(result.grid, floor_of_drive(result, trajectory))
    geometry = aligned(grid.geometry, alignment(log.truth, log.odometry))
    centres = geometry.world_of(np.moveaxis(np.indices(grid.geometry.shape), 0, -1))
    rooms = sampled(truth.rooms, truth.geometry, centres, 0).astype(np.int64)
    return MapOfRooms(f"random-{number}", SONAR, home.name, grid, np.where(grid.free, rooms, 0))
