"""The end of a drive in the paper's method: what has not been extracted becomes regions too.

The paper is silent; its last figure shows the whole home divided.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray
from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.connected import given_to_neighbours
from core.segmentation.convexity import convexity
from core.segmentation.decision import Decision, measure_cut
from core.segmentation.extraction_state import ExtractionState, lattice_corner, painted
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.inheritance import all_closed, with_region
from core.segmentation.moment import Moment
from core.segmentation.paper_config import PaperConfig
from core.segmentation.paper_cut import least_grids, tentative_cut
from core.segmentation.paper_extraction import recorded
from core.wording import counted


def finish_as_in_paper(
    state: ExtractionState, moment: Moment, config: PaperConfig | None = None
) -> ExtractionState:
    """The end of a drive: the floor that is left becomes regions, small pieces join a neighbour."""
    config, grid = config or PaperConfig(), moment.grid
    least = least_grids(grid, config)
    if config.reopening == "while_inside":
        state = all_closed(state, least)
    left = grid.free & (painted(state.closed, grid.geometry) == 0)
    one = convexity((left,), grid, config.convexity) if left.any() else 0.0
    labels, count = ndimage.label(left)
    pieces = [labels == value for value in range(1, count + 1)]
    small = [piece for piece in pieces if piece.sum() < least]
    parts = [
        part for piece in pieces if piece.sum() >= least for part in _parts(piece, grid, config)
    ]
    decisions = []
    for i, part in enumerate(parts):
        measures = measure_cut(part, left, one, grid, config.convexity)
        hidden = hidden_pairs(part, ~grid.free)
        state, region = with_region(state, part, grid.geometry, is_open=True)
        decisions.append(
            Decision(
                i + 1, measures, hidden, True, "end of the drive", region.number, region.parents
            )
        )
    state = _with_small(state, small, grid.geometry)
    said = f"end of the drive: {counted(len(decisions), 'piece')} left"
    return recorded(state, moment, tuple(parts), decisions, config, said)


def _parts(piece: BoolArray, grid: OccupancyGrid, config: PaperConfig) -> list[BoolArray]:
    """The parts of a piece that eq. (9) does not cut any more."""
    if config.at_end == "pieces" or piece.sum() < 2 * least_grids(grid, config):
        return [piece]
    found = tentative_cut(piece, grid, config)
    if found is None or not found.accepted:
        return [piece]
    halves = found.cut.first, found.cut.second
    return [part for half in halves for part in _parts(half, grid, config)]


def _with_small(
    state: ExtractionState, small: list[BoolArray], geometry: GridGeometry
) -> ExtractionState:
    """The state with pieces too small for regions in the neighbours they share the longest border with."""
    before = painted(state.regions, geometry)
    after = given_to_neighbours(before, small)
    corner = lattice_corner(geometry)
    regions = []
    for region in state.regions:
        gained = np.argwhere((after == region.number) & (before == 0)) + corner
        regions.append(replace(region, cells=np.concatenate((region.cells, gained))))
    return replace(state, regions=tuple(regions))
