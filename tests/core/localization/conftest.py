"""A flat of two rooms for localization: 4 m x 3 m and 3 m x 3 m, a door between them."""

from __future__ import annotations

import numpy as np
import pytest

from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import GridGeometry
from core.topology import Model
from core.topology.topology_of import topology_of

RESOLUTION = 0.05


def flat() -> Model:
    """Walls of 10 cm around x 0..7.1, y 0..3; the wall between the rooms at x = 4, its door at
    y 1..2; a cupboard in the south-west corner so that nothing is symmetric."""
    geometry = GridGeometry(RESOLUTION, (-0.5, -0.5, 0.0), (80, 162))
    rows, cols = np.mgrid[:80, :162]
    xy = geometry.world_of(np.stack((rows, cols), -1))
    x, y = xy[..., 0], xy[..., 1]
    inside = (x > 0) & (x < 7.1) & (y > 0) & (y < 3)
    wall = (x > 4) & (x < 4.1) & ~((y > 1) & (y < 2))
    cupboard = (x < 1.0) & (y < 0.6)
    free = inside & ~wall & ~cupboard
    near = (x > -0.1) & (x < 7.2) & (y > -0.1) & (y < 3.1)
    grid = OccupancyGrid.of(geometry, free, near & ~free)
    regions = np.where(free, np.where(x < 4.05, 1, 2), 0).astype(np.int64)
    topology = topology_of(grid, regions, labels={1: "living room", 2: "kitchen"})
    return Model(grid, regions, regions, topology, None, {})


def hall_with_bulge(bulge: float) -> Model:
    """An empty room of 6 m x 3 m that looks the same after half a turn, its halves two nodes; in
    the map its west wall bulges by some metres, over one metre, as a sonar map's walls do."""
    geometry = GridGeometry(RESOLUTION, (-0.5, -0.5, 0.0), (80, 140))
    rows, cols = np.mgrid[:80, :140]
    xy = geometry.world_of(np.stack((rows, cols), -1))
    x, y = xy[..., 0], xy[..., 1]
    free = (x > 0) & (x < 6) & (y > 0) & (y < 3) & ~((x < bulge) & (y > 1.5) & (y < 2.5))
    near = (x > -0.1) & (x < 6.1) & (y > -0.1) & (y < 3.1)
    grid = OccupancyGrid.of(geometry, free, near & ~free)
    regions = np.where(free, np.where(x < 3, 1, 2), 0).astype(np.int64)
    topology = topology_of(grid, regions, labels={1: "west", 2: "east"})
    return Model(grid, regions, regions, topology, None, {})


@pytest.fixture(scope="session")
def hall() -> Model:
    return hall_with_bulge(0.0)


@pytest.fixture(scope="session")
def hall_with_a_flaw() -> Model:
    return hall_with_bulge(0.15)


@pytest.fixture(scope="session")
def hall_with_a_cupboard() -> Model:
    return hall_with_bulge(0.6)


@pytest.fixture(scope="session")
def two_rooms() -> Model:
    return flat()
