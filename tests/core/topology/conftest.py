"""A small home whose regions, doorways and areas are known."""

from __future__ import annotations

import numpy as np
import pytest

from core.mapping import GridGeometry, OccupancyGrid
from core.topology import Model
from core.topology.labels import room_image
from core.topology.topology_of import topology_of

RESOLUTION = 0.1


def known_home() -> Model:
    """Three rooms of 2 m x 2 m side by side, 0.1 m walls with a door of 0.6 m between, 0.1 m cells.

    Room A holds two regions (1: west half, 2: east half), B is region 3, C is region 4; the doors
    belong to the room on their left. The world's origin is the outer corner of cell [0, 0].
    """
    state = np.zeros((22, 64), np.int64)
    state[1:21, 1:11] = 1
    state[1:21, 11:21] = 2
    state[1:21, 22:42] = 3
    state[1:21, 43:63] = 4
    state[8:14, 21] = 2
    state[8:14, 42] = 3
    rooms = np.where(state == 2, 1, state)
    geometry = GridGeometry(RESOLUTION, (0.0, 0.0, 0.0), state.shape)
    grid = OccupancyGrid.of(geometry, state > 0, state == 0)
    topology = topology_of(grid, state, rooms)
    return Model(grid, state, room_image(state, topology), topology, None, {})


@pytest.fixture(scope="session")
def home() -> Model:
    """The known home."""
    return known_home()
