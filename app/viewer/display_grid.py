"""A grid tidied for the eye: sonar speckle gone, walls as a smooth field. For drawing only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, FloatArray
from core.mapping import OccupancyGrid

_NEAR_FLOOR = 6
"""Cells: what is occupied further than this from any floor is not drawn in the flat picture."""


@dataclass(frozen=True)
class DisplayConfig:
    """How a grid is tidied; lengths in metres, so that it looks the same at any resolution."""

    speck_area: float = 0.012
    """Occupied specks smaller than this (m2) are not drawn: single stray echoes."""
    wall_smoothing: float = 0.04
    """Sigma of the blur that rounds the stairs of the cells off."""
    wall_level: float = 0.36
    """Where the blurred walls are cut; low enough that a wall one cell thick survives."""
    furniture_area: float = 4.0
    """Occupied islands up to this (m2) are drawn low, and filled: a sofa's outline, not a wall."""
    furniture_reach: float = 2.6
    """... and none longer than this (m)."""
    furniture_gap: float = 0.3
    """Gaps in such an outline up to this (m) are overlooked."""
    hole_area: float = 0.06
    """Unknown pinholes in the floor smaller than this (m2) are filled."""
    floor_area: float = 0.25
    """Patches of free floor smaller than this (m2) are not drawn: single stray beams."""


@dataclass(frozen=True)
class DisplayGrid:
    """What is drawn of a grid, all (rows, cols), row 0 = lowest y.

    Attributes:
        floor: cells drawn as floor.
        occupied: cells drawn as occupied in the flat picture.
        walls: 0..1 field of what stands high; drawn where it is above `level`.
        furniture: the same for low things.
        level: the iso-level of both fields.
    """

    floor: BoolArray
    occupied: BoolArray
    walls: FloatArray
    furniture: FloatArray
    level: float

    @property
    def solid(self) -> BoolArray:
        """Cells that are drawn as wall or furniture."""
        return np.asarray(np.maximum(self.walls, self.furniture) > self.level)


def tidy(grid: OccupancyGrid, config: DisplayConfig | None = None) -> DisplayGrid:
    """The grid as it is drawn."""
    config = config or DisplayConfig()
    cell = grid.geometry.resolution
    cells_of = 1.0 / grid.geometry.cell_area
    occupied = _without_specks(grid.occupied, config.speck_area * cells_of)
    low = _islands(
        occupied,
        grid.free,
        config.furniture_area * cells_of,
        config.furniture_reach / cell,
        max(1, round(config.furniture_gap / 2 / cell)),
    )
    sigma = max(config.wall_smoothing / cell, 0.6)
    floor = ndimage.binary_fill_holes(grid.free)
    holes = floor & ~grid.free & ~occupied
    floor = grid.free | (holes ^ _without_specks(holes, config.hole_area * cells_of))
    floor |= grid.occupied & ~occupied
    floor = _without_specks(floor & ~low, config.floor_area * cells_of)
    return DisplayGrid(
        floor=np.asarray(floor),
        occupied=occupied & ndimage.binary_dilation(floor | low, iterations=_NEAR_FLOOR),
        walls=_blurred(occupied & ~low, sigma),
        furniture=_blurred(low, sigma),
        level=config.wall_level,
    )


def _without_specks(mask: BoolArray, least_cells: float) -> BoolArray:
    labels, count = ndimage.label(mask, structure=np.ones((3, 3)))
    if count == 0:
        return mask
    sizes = np.bincount(labels.ravel())
    keep = sizes >= least_cells
    keep[0] = False
    return np.asarray(keep[labels])


def _islands(
    occupied: BoolArray,
    free: BoolArray,
    most_cells: float,
    most_reach: float,
    closing_cells: int,
) -> BoolArray:
    """Occupied pieces that are small and stand in free floor, what they enclose included."""
    labels, _ = ndimage.label(occupied, structure=np.ones((3, 3)))
    outside = ~ndimage.binary_fill_holes(free | occupied)
    at_border = ndimage.binary_dilation(outside, iterations=2)
    reachable = _largest(free)
    low = np.zeros(occupied.shape, bool)
    for index, box in enumerate(ndimage.find_objects(labels), start=1):
        if max(side.stop - side.start for side in box) > most_reach:
            continue
        piece = labels[box] == index
        if (piece & at_border[box]).any():
            continue
        filled = _filled(piece, closing_cells)
        if filled.sum() <= most_cells:
            low[box] |= piece | (filled & ~reachable[box])
    return low


def _filled(piece: BoolArray, closing_cells: int) -> BoolArray:
    """A piece with what it encloses, also through gaps of up to twice `closing_cells`."""
    padded = np.pad(piece, closing_cells + 1)
    square = np.ones((3, 3), bool)
    closed = ndimage.binary_closing(padded, square, iterations=closing_cells)
    inner = slice(closing_cells + 1, -closing_cells - 1)
    return np.asarray(ndimage.binary_fill_holes(closed)[inner, inner])


def _largest(mask: BoolArray) -> BoolArray:
    labels, count = ndimage.label(mask)
    if count == 0:
        return mask
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    return np.asarray(labels == sizes.argmax())


def _blurred(mask: BoolArray, sigma: float) -> FloatArray:
    return np.asarray(ndimage.gaussian_filter(mask.astype(float), sigma, mode="constant"))
