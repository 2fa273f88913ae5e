"""The floor as pictures: the occupancy grid as it is, and the regions as soft colours over it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from PIL import Image
from scipy import ndimage

from app.viewer.display_grid import DisplayGrid
from app.viewer.palette import Colour
from core.geometry import BoolArray, IntArray
from core.mapping import OccupancyGrid

Picture = npt.NDArray[np.uint8]
"""RGBA, (rows, cols, 4), row 0 = lowest y like the grid; viser's images need no flip."""
Field = npt.NDArray[np.float32]
_LINE_STRENGTH = 0.75
_FULL_LINE = 3.3
"""A blurred line of one pixel, times its sigma and this, is full in its middle and a little beside."""


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
    shadow = ndimage.gaussian_filter(known.astype(np.float32), reach) * theme.shadow
    rgba = np.zeros((*known.shape, 4), np.uint8)
    rgba[..., 3] = shadow * 255
    rgba[floor] = (*theme.free, 255)
    rgba[occupied] = (*theme.occupied, 255)
    return np.asarray(rgba.repeat(scale, axis=0).repeat(scale, axis=1), np.uint8)


@dataclass(frozen=True)
class RegionShapes:
    """What the regions' pictures of all themes share, at a picture's pixels.

    Attributes:
        labels: region of each pixel, 0 = none.
        border: 0..1, 1 on a line between two regions.
        shade: 0..1, 1 right at a wall.
    """

    labels: IntArray
    border: Field
    shade: Field


def region_shapes(
    regions: IntArray, display: DisplayGrid, config: FloorConfig, scale: int, resolution: float
) -> RegionShapes:
    """The regions with smooth borders, and where the walls darken them."""
    labels = smooth_labels(_under_walls(regions, display.solid | display.floor), scale)
    solid = display.solid
    shade = np.zeros(solid.shape, np.float32)
    if solid.any():
        distance = ndimage.distance_transform_edt(~solid) * resolution
        shade = np.exp(-distance / config.shade_reach).astype(np.float32)
    border = _between_regions(labels, config.line_width * scale / resolution)
    return RegionShapes(labels, border, enlarged(shade, scale))


def region_picture(
    shapes: RegionShapes, colours: Mapping[int, Colour], theme: FloorTheme
) -> Picture:
    """The regions in their colours of one theme; transparent where there is none."""
    free, line = (np.array(colour, np.float32) for colour in (theme.free, theme.line))
    table = np.zeros((int(shapes.labels.max()) + 1, 3), np.float32)
    for region, colour in colours.items():
        if region < len(table):
            table[region] = free + theme.tint * (np.array(colour, np.float32) - free)
    picture = np.zeros((*shapes.labels.shape, 4), np.uint8)
    light = 1 - theme.shade * shapes.shade
    blend = _LINE_STRENGTH * shapes.border
    for channel in range(3):
        value = table[shapes.labels, channel]
        value += (line[channel] - value) * blend
        picture[..., channel] = value * light
    picture[..., 3] = np.where(shapes.labels > 0, 255, 0)
    return picture


def smooth_labels(labels: IntArray, scale: int, blur_cells: float = 0.8) -> IntArray:
    """A label image (rows, cols) at `scale` pixels per cell, its borders rounded.

    Each region is blurred by itself and the strongest wins, so that neighbours keep touching.
    """
    rows, cols = labels.shape
    best = np.full((rows * scale, cols * scale), 0.5, np.float32)
    out = np.zeros(best.shape, np.int64)
    reach = int(np.ceil(3 * blur_cells))
    for region, box in enumerate(ndimage.find_objects(labels), start=1):
        if box is None:
            continue
        r0, r1 = max(box[0].start - reach, 0), min(box[0].stop + reach, rows)
        c0, c1 = max(box[1].start - reach, 0), min(box[1].stop + reach, cols)
        mask = (labels[r0:r1, c0:c1] == region).astype(np.float32)
        fine = enlarged(ndimage.gaussian_filter(mask, blur_cells, mode="nearest"), scale)
        window = (slice(r0 * scale, r1 * scale), slice(c0 * scale, c1 * scale))
        wins = fine >= best[window]
        best[window][wins] = fine[wins]
        out[window][wins] = region
    return out


def enlarged(field: Field, scale: int) -> Field:
    """A field (rows, cols) at `scale` pixels per cell, interpolated between the cells' centres."""
    if scale == 1:
        return field
    rows, cols = field.shape
    image = Image.fromarray(np.ascontiguousarray(field, np.float32))
    larger = image.resize((cols * scale, rows * scale), Image.Resampling.BILINEAR)
    return np.asarray(larger, np.float32)


def _under_walls(regions: IntArray, below: BoolArray, reach_cells: int = 3) -> IntArray:
    """Regions grown a little under walls and specks, so that no gap shows at the walls' feet."""
    grown = regions
    for _ in range(reach_cells):
        around = ndimage.maximum_filter(grown, size=3)
        grown = np.where(below & (grown == 0), around, grown)
    return grown


def _between_regions(labels: IntArray, width: float) -> Field:
    """1 on the border between two regions, falling to 0 within about `width` pixels."""
    border = np.zeros(labels.shape, np.float32)
    down = (labels[1:] != labels[:-1]) & (labels[1:] > 0) & (labels[:-1] > 0)
    right = (labels[:, 1:] != labels[:, :-1]) & (labels[:, 1:] > 0) & (labels[:, :-1] > 0)
    border[1:] = down
    border[:, 1:] = np.maximum(border[:, 1:], right)
    if not border.any():
        return border
    sigma = max(width / 2, 0.4)
    blurred = ndimage.gaussian_filter(border, sigma)
    return np.asarray(np.clip(blurred * sigma * _FULL_LINE, 0, 1), np.float32)


def _margin_cells(grid: OccupancyGrid, config: FloorConfig) -> int:
    return int(np.ceil(config.margin / grid.geometry.resolution))
