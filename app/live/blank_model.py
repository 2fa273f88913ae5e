"""What a mapping session shows before its first model is made: nothing yet, around its first pose."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import GridGeometry
from core.topology import Model, TopologicalMap

REACH_M, RESOLUTION_M = 3.0, 0.05


def blank_model(recording: Path) -> Model:
    """A model without anything in it. Reads the recording's first scan: call it in a thread."""
    with recording.open("rb") as file:
        file.readline()
        line = file.readline()
    start = json.loads(line)["odom"][:2] if line.endswith(b"\n") else (0.0, 0.0)
    geometry = GridGeometry.around(np.array([start], float), REACH_M, RESOLUTION_M)
    nothing = np.zeros(geometry.shape, np.int64)
    grid = OccupancyGrid(geometry, np.zeros(geometry.shape, np.uint8))
    return Model(grid, nothing, nothing, TopologicalMap((), (), ()), None, {})
