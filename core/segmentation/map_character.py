"""What a map is like as a whole: a narrow passage means less in a hall full of tables."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray


@dataclass(frozen=True)
class MapCharacter:
    """A map as a whole.

    Attributes:
        area: square metres of its floor.
        specks: obstacles that stand alone and are small enough to be filled in, for each m2.
        furniture: share of the floor that larger obstacles cover which stand alone.
    """

    area: float
    specks: float
    furniture: float


def map_character(
    free: BoolArray, floor: BoolArray, bare: BoolArray, resolution: float
) -> MapCharacter:
    """Measures a map.

    Args:
        free: (rows, cols) free space of the map.
        floor: the same with small lone obstacles filled in; it has at least one cell.
        bare: the same with larger ones filled in, too.
        resolution: metres per cell.
    """
    cells = int(floor.sum())
    area = cells * resolution**2
    _, specks = ndimage.label(np.asarray(floor & ~free))
    return MapCharacter(area, specks / area, float(bare.sum()) / cells - 1)
