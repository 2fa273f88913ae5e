"""The floor as a person sees it: chair legs and boxes taken away, crumbs of free space left out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray

AROUND = np.ones((3, 3), bool)


@dataclass(frozen=True)
class ClutterConfig:
    """Sizes in square metres.

    Attributes:
        largest_obstacle: obstacles that stand alone and cover less are filled in: a table leg or a
            chair makes no room of its own.
        least_floor: pieces of free space that are smaller are no floor.
    """

    largest_obstacle: float = 0.3
    least_floor: float = 1.0


def uncluttered(
    free: BoolArray, resolution: float, config: ClutterConfig | None = None
) -> BoolArray:
    """Free space (rows, cols) with small lone obstacles filled in and small lone pieces dropped."""
    config = config or ClutterConfig()
    cell_area = resolution**2
    obstacles, count = ndimage.label(np.pad(~free, 1, constant_values=True), AROUND)
    small = np.bincount(obstacles.ravel(), minlength=count + 1) * cell_area
    lone = small < config.largest_obstacle
    lone[0] = False
    floor = free | lone[obstacles[1:-1, 1:-1]]
    pieces, count = ndimage.label(floor)
    large = np.bincount(pieces.ravel(), minlength=count + 1) * cell_area >= config.least_floor
    large[0] = False
    if not large.any() and count:
        large[np.bincount(pieces.ravel())[1:].argmax() + 1] = True
    return np.asarray(large[pieces])
