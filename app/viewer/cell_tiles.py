"""The quadtree cells that the regions were made of (paper, 3.1.1), as tiles on the floor."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from app.viewer.palette import Colour, mix
from core.geometry import FloatArray
from core.segmentation.cell_decomposition import decompose
from core.topology import Model

TILE_LEVEL = 0.03
JOINT = 0.02
"""Metres: height of the tiles above the floor, and the gap between two of them."""
_WITHOUT_REGION: Colour = (196, 202, 214)
_LIGHTEN = 0.45
_WHITE: Colour = (255, 255, 255)


@dataclass(frozen=True)
class Tiles:
    """Squares on the floor: `centres` (N, 3), `sizes` (N,) in metres, one colour each."""

    centres: FloatArray
    sizes: FloatArray
    colours: tuple[Colour, ...]


def cell_tiles(model: Model, region_colours: Mapping[int, Colour]) -> Tiles:
    """One tile per quadtree cell of the free space, in a light tone of its region's colour."""
    geometry = model.grid.geometry
    cells = decompose(model.grid.free)
    middle = np.column_stack((cells.row, cells.col)) + (cells.size[:, None] - 1) / 2
    flat = geometry.world_of(middle).reshape(-1, 2)
    regions = model.regions[cells.row, cells.col].tolist()
    tones = {region: mix(colour, _WHITE, _LIGHTEN) for region, colour in region_colours.items()}
    sizes = cells.size * geometry.resolution
    return Tiles(
        np.column_stack((flat, np.full(len(flat), TILE_LEVEL))),
        np.maximum(sizes - JOINT, 0.6 * sizes),
        tuple(tones.get(region, _WITHOUT_REGION) for region in regions),
    )
