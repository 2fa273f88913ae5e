"""Where the robot has been, nothing stands."""

from __future__ import annotations

import numpy as np

from core.geometry import BoolArray, FloatArray
from core.mapping.occupancy_grid import GridGeometry


def driven_over(geometry: GridGeometry, poses: FloatArray, radius: float) -> BoolArray:
    """Mask (rows, cols) of the cells under the round footprint at any of the poses (N, 3).

    Args:
        geometry: the grid, not rotated.
        poses: world poses; consecutive ones closer than half a cell are looked at once.
        radius: metres.
    """
    mask = np.zeros(geometry.shape, bool)
    visited = np.unique(np.round(poses[:, :2] / (geometry.resolution / 2)), axis=0)
    visited *= geometry.resolution / 2
    reach = int(np.ceil(radius / geometry.resolution)) + 1
    span = np.arange(-reach, reach + 1)
    offsets = np.stack(np.meshgrid(span, span, indexing="ij"), axis=-1).reshape(-1, 2)
    for chunk in np.array_split(visited, max(1, len(visited) // 4096)):
        cells = geometry.cell_of(chunk)[:, None, :] + offsets[None]
        centres = geometry.world_of(cells)
        near = np.hypot(*np.moveaxis(centres - chunk[:, None, :], -1, 0)) <= radius
        inside = near & geometry.contains(cells)
        mask[cells[..., 0][inside], cells[..., 1][inside]] = True
    return mask
