"""The floor as pictures: the occupancy grid as it is, and the regions as soft colours over it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from app.viewer.display_grid import DisplayGrid
from app.viewer.palette import Colour
from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping import OccupancyGrid

Picture = npt.NDArray[np.uint8]
"""RGBA, (rows, cols, 4), row 0 = lowest y like the grid; viser's images need no flip."""


@dataclass(frozen=True)
class FloorTheme:
    """Colours of the floor in one of the page's themes."""

    free: Colour
    occupied: Colour
    line: Colour
    tint: float
    """Share of the region's colour in its floor."""
    shade: float
    """How dark the floor gets right at a wall (0..1)."""
    shadow: float
    """Opacity of the map's shadow on the page behind it."""


LIGHT = FloorTheme((246, 248, 252), (150, 158, 172), (255, 255, 255), 0.62, 0.30, 0.22)
DARK = FloorTheme((58, 66, 82), (122, 132, 150), (34, 40, 52), 0.62, 0.42, 0.55)


@dataclass(frozen=True)
class FloorConfig:
    """How the pictures are made; lengths in metres."""

    most_pixels: int = 1_400_000
    """Above this a picture is made coarser (it costs 0.2 s and 0.5 MB at this size)."""
    most_scale: int = 4
    """Pixels per cell at most."""
    shade_reach: float = 0.16
    """How far a wall darkens the floor."""
    shadow_reach: float = 0.25
    margin: float = 0.8
    """Added around the grid, for the shadow."""
    line_width: float = 0.025
    """Half the width of the line between two regions."""


def picture_scale(shape: tuple[int, int], config: FloorConfig) -> int:
    """Pixels per cell that keep a picture of this grid within `most_pixels`."""
    scale = int(np.sqrt(config.most_pixels / (shape[0] * shape[1])))
    return max(1, min(config.most_scale, scale))


def grid_picture(
    grid: OccupancyGrid, display: DisplayGrid, theme: FloorTheme, config: FloorConfig, scale: int
) -> Picture:
    """Free, occupied and unknown (transparent) without specks, over the map's soft shadow.

    Padded by `config.margin` on every side.
    """
    pad = _margin_cells(grid, config)
    known = np.pad(display.floor | display.occupied | display.solid, pad)
    floor, occupied = np.pad(display.floor, pad), np.pad(display.occupied, pad)
    reach = config.shadow_reach / grid.geometry.resolution
    shadow = ndimage.gaussian_filter(known.astype(float), reach) * theme.shadow
    rgba = np.zeros((*known.shape, 4))
    rgba[..., 3] = shadow * 255
    rgba[floor] = (*theme.free, 255)
    rgba[occupied] = (*theme.occupied, 255)
    return enlarged(rgba.astype(np.uint8), scale)


def region_picture(
    regions: IntArray,
    display: DisplayGrid,
    colours: Mapping[int, Colour],
    theme: FloorTheme,
    config: FloorConfig,
    scale: int,
    resolution: float,
) -> Picture:
    """The regions in their colours, with smooth borders, darkened softly along the walls."""
    labels = smooth_labels(_under_walls(regions, display.solid | display.floor), scale)
    pixel = resolution / scale
    table = np.zeros((int(labels.max()) + 1, 3))
    for region, colour in colours.items():
        if region < len(table):
            table[region] = np.array(theme.free) + theme.tint * (
                np.array(colour, float) - np.array(theme.free)
            )
    rgb = table[labels]
    rgb += (np.array(theme.line, float) - rgb) * (
        0.75 * _between_regions(labels, config.line_width / pixel)[..., None]
    )
    solid = (
        ndimage.zoom(
            np.maximum(display.walls, display.furniture),
            scale,
            order=1,
            mode="nearest",
            grid_mode=True,
        )
        > display.level
    )
    distance = ndimage.distance_transform_edt(~solid) * pixel if solid.any() else np.inf
    shade = theme.shade * np.exp(-np.asarray(distance) / config.shade_reach)
    rgb *= (1 - shade)[..., None] if np.ndim(shade) else 1.0
    alpha = np.where(labels > 0, 255, 0)
    return np.dstack((np.clip(rgb, 0, 255), alpha)).astype(np.uint8)


def smooth_labels(labels: IntArray, scale: int, blur_cells: float = 0.8) -> IntArray:
    """A label image (rows, cols) at `scale` pixels per cell, its borders rounded.

    Each region is blurred by itself and the strongest wins, so that neighbours keep touching.
    """
    rows, cols = labels.shape
    best = np.full((rows * scale, cols * scale), 0.5)
    out = np.zeros(best.shape, np.int64)
    reach = int(np.ceil(3 * blur_cells))
    for region, box in enumerate(ndimage.find_objects(labels), start=1):
        if box is None:
            continue
        r0, r1 = max(box[0].start - reach, 0), min(box[0].stop + reach, rows)
        c0, c1 = max(box[1].start - reach, 0), min(box[1].stop + reach, cols)
        mask = (labels[r0:r1, c0:c1] == region).astype(float)
        fine = np.kron(mask, np.ones((scale, scale)))
        fine = ndimage.gaussian_filter(fine, blur_cells * scale, mode="nearest")
        window = (slice(r0 * scale, r1 * scale), slice(c0 * scale, c1 * scale))
        wins = fine >= best[window]
        best[window][wins] = fine[wins]
        out[window][wins] = region
    return out


def enlarged(picture: Picture, scale: int) -> Picture:
    """Every pixel as a square of `scale` pixels."""
    return np.asarray(picture.repeat(scale, axis=0).repeat(scale, axis=1), np.uint8)


def _under_walls(regions: IntArray, below: BoolArray, reach_cells: int = 3) -> IntArray:
    """Regions grown a little under walls and specks, so that no gap shows at the walls' feet."""
    if not (regions > 0).any():
        return regions
    distance, nearest = ndimage.distance_transform_edt(regions == 0, return_indices=True)
    grow = below & (regions == 0) & (distance <= reach_cells)
    grown = regions.copy()
    grown[grow] = regions[nearest[0][grow], nearest[1][grow]]
    return grown


def _between_regions(labels: IntArray, width: float) -> FloatArray:
    """1 on the border between two regions, falling to 0 within `width` pixels."""
    border = np.zeros(labels.shape, bool)
    for axis in (0, 1):
        a = labels[1:] if axis == 0 else labels[:, 1:]
        b = labels[:-1] if axis == 0 else labels[:, :-1]
        differs = (a != b) & (a > 0) & (b > 0)
        if axis == 0:
            border[1:] |= differs
        else:
            border[:, 1:] |= differs
    if not border.any():
        return np.zeros(labels.shape)
    distance = ndimage.distance_transform_edt(~border)
    return np.asarray(np.clip(1.5 - distance / max(width, 0.75), 0, 1))


def _margin_cells(grid: OccupancyGrid, config: FloorConfig) -> int:
    return int(np.ceil(config.margin / grid.geometry.resolution))
