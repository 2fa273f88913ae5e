"""What a mapping method returns, and the limits that all of them share."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from core.errors import MapError
from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping.occupancy_grid import GridGeometry, OccupancyGrid

MAX_CELLS = 25_000_000
"""Cells of the largest grid that is made: 250 m x 250 m at 5 cm."""
CROP_MARGIN = 0.5
"""Metres of unknown left around what is known."""


@dataclass(frozen=True)
class MapResult:
    """A map.

    Attributes:
        grid: the occupancy grid.
        confidence: (rows, cols) Conf of eq. (5) of the occupied cells, 0 elsewhere.
        kept: (N, S) which readings of the log the map is made of.
        witnesses: (rows, cols) how many of these call each cell empty; 0 under a robot that no
            reading speaks of.
    """

    grid: OccupancyGrid
    confidence: FloatArray
    kept: BoolArray
    witnesses: IntArray


def check_size(geometry: GridGeometry) -> None:
    """Refuses grids that no laptop could hold.

    Raises:
        MapError: more than `MAX_CELLS` cells.
    """
    rows, cols = geometry.shape
    if rows * cols > MAX_CELLS:
        width, height = cols * geometry.resolution, rows * geometry.resolution
        raise MapError(
            f"the drive spans {width:.0f} m x {height:.0f} m, too much for a grid of "
            f"{geometry.resolution * 100:g} cm cells; check the units of the odometry, cut the log "
            "at the jump, or use a coarser --resolution"
        )


def cropped(result: MapResult) -> MapResult:
    """The same map without the unknown cells around it; the frame stays as it is."""
    state = result.grid.state
    known = np.argwhere(state > 0)
    if len(known) == 0:
        return result
    geometry = result.grid.geometry
    margin = round(CROP_MARGIN / geometry.resolution)
    low = np.maximum(known.min(axis=0) - margin, 0)
    high = np.minimum(known.max(axis=0) + 1 + margin, geometry.shape)
    part = (slice(low[0], high[0]), slice(low[1], high[1]))
    corner = np.array(geometry.origin[:2]) + low[::-1] * geometry.resolution
    moved = GridGeometry(
        geometry.resolution,
        (float(corner[0]), float(corner[1]), geometry.origin[2]),
        (int(high[0] - low[0]), int(high[1] - low[1])),
    )
    grid = OccupancyGrid(moved, np.ascontiguousarray(state[part]))
    return replace(
        result,
        grid=grid,
        confidence=np.ascontiguousarray(result.confidence[part]),
        witnesses=np.ascontiguousarray(result.witnesses[part]),
    )
