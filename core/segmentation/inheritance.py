"""Which number a part that becomes a region gets: that of the region it was, or a new one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.geometry import BoolArray, IntArray
from core.mapping import GridGeometry
from core.segmentation.extraction_state import (
    ExtractedRegion,
    ExtractionState,
    lattice_corner,
    painted,
)

LEAST_OVERLAP = 0.5
"""Share of an open region that a part must cover to be its heir: only one part can."""


def with_region(
    state: ExtractionState,
    mask: BoolArray,
    geometry: GridGeometry,
    is_open: bool = False,
) -> tuple[ExtractionState, ExtractedRegion]:
    """The state with a part extracted: the heir of an open region that it covers, or a new one."""
    cells = np.argwhere(mask) + lattice_corner(geometry)
    waiting = tuple(region for region in state.regions if region.is_open)
    numbers = painted(waiting, geometry)[mask]
    parents, heir = [], None
    for region in waiting:
        shared = int((numbers == region.number).sum())
        if shared >= LEAST_OVERLAP * len(region.cells) and heir is None:
            heir = region.number
        if shared:
            parents.append(region.number)
    regions = tuple(_without(region, cells) for region in state.regions if region.number != heir)
    regions = tuple(r for r in regions if len(r.cells))
    lineage = tuple(p for p in parents if p != heir)
    number = state.next_number if heir is None else heir
    new = ExtractedRegion(number, cells, lineage, is_open)
    following = state.next_number + (heir is None)
    return replace(state, regions=(*regions, new), next_number=following), new


def _without(region: ExtractedRegion, cells: IntArray) -> ExtractedRegion:
    """An open region without cells that another one has taken."""
    if not region.is_open:
        return region
    low = np.minimum(region.cells.min(axis=0), cells.min(axis=0))
    span = int(max(region.cells[:, 1].max(), cells[:, 1].max()) - low[1]) + 1
    keys = [(c[:, 0] - low[0]) * span + c[:, 1] - low[1] for c in (region.cells, cells)]
    return replace(region, cells=region.cells[~np.isin(*keys)])
