"""Regions that open again when the robot is back, and who inherits their numbers."""

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


def reopened(
    state: ExtractionState, geometry: GridGeometry, robot: IntArray
) -> tuple[ExtractionState, str]:
    """The state with the region that the robot is back in open again, and that in words."""
    here = int(painted(state.regions, geometry)[tuple(robot)])
    if not any(r.number == here and not r.is_open for r in state.regions):
        return state, ""
    regions = tuple(replace(r, is_open=True) if r.number == here else r for r in state.regions)
    return replace(state, regions=regions), f"the robot is back in region {here}; "


def opened_inside(
    state: ExtractionState, geometry: GridGeometry, robot: IntArray, least: float
) -> tuple[ExtractionState, str]:
    """The state in which no region is open but the one that the robot is in, and that in words.

    Regions that are left with less than `least` grids are given up.
    """
    here = int(painted(state.regions, geometry)[tuple(robot)])
    was_closed = any(r.number == here and not r.is_open for r in state.regions)
    others = all_closed(replace(state, regions=_but(state, here)), least).regions
    inside = tuple(replace(r, is_open=True) for r in state.regions if r.number == here)
    said = f"the robot is back in region {here}; " if was_closed else ""
    return replace(state, regions=(*others, *inside)), said


def all_closed(state: ExtractionState, least: float) -> ExtractionState:
    """The state with open regions of at least so many grids closed and smaller ones given up."""
    kept = (r for r in state.regions if not r.is_open or len(r.cells) >= least)
    return replace(state, regions=tuple(replace(r, is_open=False) for r in kept))


def taken_in(
    state: ExtractionState, mask: BoolArray, geometry: GridGeometry, robot: IntArray
) -> ExtractionState:
    """The state in which the open region that the robot is in covers a mask, and nothing else."""
    here = int(painted(state.regions, geometry)[tuple(robot)])
    inside = next((r for r in state.regions if r.number == here and r.is_open), None)
    if inside is None:
        return state
    cells = np.argwhere(mask) + lattice_corner(geometry)
    others = tuple(_without(region, cells) for region in _but(state, here))
    others = tuple(region for region in others if len(region.cells))
    return replace(state, regions=(*others, replace(inside, cells=cells)))


def _but(state: ExtractionState, number: int) -> tuple[ExtractedRegion, ...]:
    """All regions but one."""
    return tuple(region for region in state.regions if region.number != number)


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
