"""The template: the grids of a local map that can be trusted (paper, Sect. 4.1, eq. 5-6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import BoolArray, FloatArray
from core.mapping.map_result import MapResult


@dataclass(frozen=True)
class Template:
    """A template grid map.

    Attributes:
        occupied: (rows, cols) the confident occupied grids, cut to their bounding box.
        centre: (2,) `(x_c, y_c)` of eq. (10) in the frame of the local map, metres.
        points: (K, 2) the occupied grids in that frame, metres.
        radius: R of eq. (10) in grids.
    """

    occupied: BoolArray
    centre: FloatArray
    points: FloatArray
    radius: int


def confident(result: MapResult) -> BoolArray:
    """Occupied grids whose confidence exceeds the average of all occupied grids, eq. (6)."""
    occupied = result.grid.occupied
    if not occupied.any():
        return occupied
    return np.asarray(occupied & (result.confidence > result.confidence[occupied].mean()))


def template_of(result: MapResult) -> Template | None:
    """The template of a local map; None when it has no confident grid.

    The paper calls (x_c, y_c) "the center point of the template grid map": taken as the centre of
    the bounding box of the confident grids. R is half of its shorter side (4.2.1).
    """
    cells = np.argwhere(confident(result))
    if len(cells) == 0:
        return None
    low, high = cells.min(axis=0), cells.max(axis=0)
    mask = np.zeros(tuple(high - low + 1), bool)
    mask[tuple((cells - low).T)] = True
    geometry = result.grid.geometry
    return Template(
        mask,
        geometry.world_of((low + high) / 2),
        geometry.world_of(cells),
        max(1, int(min(mask.shape) // 2)),
    )
