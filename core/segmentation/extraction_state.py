"""What autonomous modelling knows between two steps: the extracted regions and their lineage."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.geometry import IntArray
from core.mapping import GridGeometry


@dataclass(frozen=True)
class ExtractedRegion:
    """A region that has been taken out of the remaining space.

    Attributes:
        number: its identity, never used again.
        cells: (n, 2) its cells on the lattice of the world (`lattice_corner`), so that the region
            stays where it is when the grid grows.
        parents: numbers of the regions that it was split from or merged of.
        is_open: the robot is back in it: it takes part in segmentation again, its number waits.
    """

    number: int
    cells: IntArray
    parents: tuple[int, ...] = ()
    is_open: bool = False


@dataclass(frozen=True)
class ExtractionState:
    """The extracted regions in order of extraction, the next number, and every decision."""

    regions: tuple[ExtractedRegion, ...] = ()
    next_number: int = 1
    history: tuple[dict[str, Any], ...] = ()

    def with_entry(self, entry: dict[str, Any]) -> ExtractionState:
        """The state after one more decision."""
        return replace(self, history=(*self.history, entry))


def lattice_corner(geometry: GridGeometry) -> IntArray:
    """`[row, col]` of a grid's cell [0, 0] on the lattice of all grids of this resolution."""
    x, y = geometry.origin[:2]
    return np.rint(np.array([y, x]) / geometry.resolution).astype(np.int64)


def painted(regions: tuple[ExtractedRegion, ...], geometry: GridGeometry) -> IntArray:
    """Label image (rows, cols) of regions by their numbers, 0 = none."""
    labels = np.zeros(geometry.shape, np.int64)
    corner = lattice_corner(geometry)
    for region in regions:
        cells = region.cells - corner
        cells = cells[geometry.contains(cells)]
        labels[cells[:, 0], cells[:, 1]] = region.number
    return labels
