"""Draft cells: free space cut at every place that might be the border of a room.

The counterpart of the quadtree for finding rooms: the watershed of the clearance (distance to the
nearest obstacle) meets at every constriction, wall extensions add the openings that are no
constriction. Far too many cells; merging (`merging.py`) decides which borders stay.
"""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass, field

import numba
import numpy as np
from scipy import ndimage
from skimage.draw import line
from skimage.measure import label
from skimage.segmentation import watershed

from core.geometry import BoolArray, FloatArray, IntArray
from core.segmentation.boundary_points import boundary_points
from core.segmentation.reconstruction import reconstruction
from core.segmentation.wall_extensions import ExtensionConfig, wall_extensions

OVERSHOOT = 1.5
"""Cells by which an extension is drawn longer, so that it surely reaches both walls."""


@dataclass(frozen=True)
class DraftConfig:
    """Parameters of the draft.

    Attributes:
        depth: metres by which the clearance must fall between two maxima for two cells.
        smoothing: standard deviation in cells of the blur of the clearance.
        least_area: square metres; smaller cells join the neighbour with the longest border.
        extensions: of the wall extensions.
    """

    depth: float = 0.05
    smoothing: float = 1.0
    least_area: float = 1.0
    extensions: ExtensionConfig = field(default_factory=ExtensionConfig)


def clearance_of(floor: BoolArray, resolution: float) -> FloatArray:
    """Distance of each cell (rows, cols) to the nearest that is no floor, in metres."""
    nearest = ndimage.distance_transform_edt(
        np.pad(floor, 1), return_distances=False, return_indices=True
    )
    return np.asarray(_distances(nearest)[1:-1, 1:-1] * resolution)


@numba.njit(cache=True)
def _distances(nearest):  # type: ignore[no-untyped-def]
    """Distance (rows, cols) of each cell to another one, `nearest` (2, rows, cols); lean in memory."""
    _, rows, cols = nearest.shape
    out = np.empty((rows, cols))
    for r in range(rows):
        for c in range(cols):
            out[r, c] = math.sqrt((nearest[0, r, c] - r) ** 2 + (nearest[1, r, c] - c) ** 2)
    return out


def draft_cells(
    floor: BoolArray, clearance: FloatArray, resolution: float, config: DraftConfig | None = None
) -> IntArray:
    """Label image (rows, cols) of the draft cells 1..n, 0 outside the floor."""
    config = config or DraftConfig()
    barrier = _drawn(wall_extensions(floor, resolution, config.extensions), floor)
    basins = _basins(floor, clearance, config)
    basins[barrier] = 0
    cells = np.asarray(label(basins, connectivity=1, background=0), np.int64)  # type: ignore[no-untyped-call]
    del basins  # a large image of a large map
    _fill(cells, floor & (cells == 0))
    return _without_slivers(cells, config.least_area / resolution**2)


def _fill(cells: IntArray, gaps: BoolArray) -> None:
    """Gives gaps the label of the nearest cell that has one."""
    nearest = ndimage.distance_transform_edt(
        cells == 0, return_distances=False, return_indices=True
    )
    cells[gaps] = cells[tuple(nearest[:, gaps])]


def _basins(floor: BoolArray, clearance: FloatArray, config: DraftConfig) -> IntArray:
    """Watershed of the clearance from its maxima that stand out by the depth (h-maxima)."""
    smooth = ndimage.gaussian_filter(clearance, config.smoothing) * floor
    markers, _ = ndimage.label(_stands_out(smooth, config.depth) & floor, np.ones((3, 3)))
    return np.asarray(watershed(-smooth, markers, mask=floor), np.int64)  # type: ignore[no-untyped-call]


def _stands_out(image: FloatArray, depth: float) -> BoolArray:
    """The maxima from which every way to a higher one falls by the depth."""
    domes = image - reconstruction(image - depth, image)
    return np.asarray(domes >= depth - 1e-6)


def _drawn(segments: FloatArray, floor: BoolArray) -> BoolArray:
    """The cells of segments (n, 2, 2) on the floor."""
    drawn = np.zeros(floor.shape, bool)
    for start, stop in segments:
        ahead = stop - start
        ahead = ahead / max(float(np.hypot(*ahead)), 1e-9) * OVERSHOOT
        ends = np.rint(np.concatenate((start - ahead, stop + ahead))).astype(int)
        row, col = line(*ends)  # type: ignore[no-untyped-call]
        inside = (row >= 0) & (col >= 0) & (row < floor.shape[0]) & (col < floor.shape[1])
        drawn[row[inside], col[inside]] = True
    return drawn & floor


def _without_slivers(cells: IntArray, least: float) -> IntArray:
    """Small cells given to the neighbour with the longest common border, the smallest first."""
    count = int(cells.max(initial=0)) + 1
    area = np.bincount(cells.ravel(), minlength=count).astype(float)
    present = area > 0
    border: list[dict[int, int]] = [{} for _ in range(count)]
    for (low, high), points in boundary_points(cells).items():
        border[low][high] = border[high][low] = len(points)
    parent = np.arange(count)
    waiting = [(area[k], k) for k in range(1, count) if 0 < area[k] < least]
    heapq.heapify(waiting)
    while waiting:
        size, cell = heapq.heappop(waiting)
        if parent[cell] != cell or size != area[cell] or not border[cell]:
            continue
        to = max(border[cell], key=lambda other: (border[cell][other], -other))
        parent[parent == cell] = to
        area[to] += area[cell]
        for other, length in border[cell].items():
            del border[other][cell]
            if other != to:
                border[to][other] = border[other][to] = border[to].get(other, 0) + length
        border[cell] = {}
        if area[to] < least:
            heapq.heappush(waiting, (area[to], to))
    kept = np.zeros(count, bool)
    kept[parent[present]] = True
    kept[0] = False
    return np.asarray(np.cumsum(kept)[parent] * (parent > 0))[cells]
