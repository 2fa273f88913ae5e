"""One step of autonomous extraction as in the paper (3.2.2), with its open points as options."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy import ndimage

from core.geometry import FloatArray, IntArray
from core.mapping import OccupancyGrid
from core.segmentation.convex_split import two_way_cut
from core.segmentation.convexity import ConvexityConfig, convexity, is_to_be_cut
from core.segmentation.extraction_state import (
    ExtractedRegion,
    ExtractionState,
    lattice_corner,
    painted,
)
from core.segmentation.reliable_region import ReliableConfig, reliable_region


@dataclass(frozen=True)
class PaperConfig:
    """Parameters of the paper's extraction.

    Attributes:
        reliable: of the reliable region (eq. 6).
        convexity: of the condition (eq. 7-9).
        least_area: square metres of a cluster; the paper tells of none.
        max_cell: largest quadtree cell in grids.
    """

    reliable: ReliableConfig = field(default_factory=ReliableConfig)
    convexity: ConvexityConfig = field(default_factory=ConvexityConfig)
    least_area: float = 1.0
    max_cell: int = 32


def extract_as_in_paper(
    state: ExtractionState,
    grid: OccupancyGrid,
    confidence: FloatArray,
    pose: FloatArray,
    t: float,
    config: PaperConfig | None = None,
) -> ExtractionState:
    """One step: the reliable cells are cut in two; if eq. (9) holds, the farther half is extracted.

    Args:
        state: what is known so far.
        grid: the local map.
        confidence: Conf of eq. (5), (rows, cols).
        pose: (3,) the robot in the map's frame.
        t: seconds, for the history.
        config: parameters and open points.
    """
    config = config or PaperConfig()
    robot = grid.geometry.cell_of(pose[:2])
    if not grid.geometry.contains(robot) or not grid.free[tuple(robot)]:
        return state
    state = _without_region_of(state, grid, robot)
    taken = painted(state.regions, grid.geometry) > 0
    reliable = reliable_region(grid, confidence, robot, config.reliable) & ~taken
    pieces, _ = ndimage.label(reliable)
    cells = (pieces == pieces[tuple(robot)]) & reliable
    least = config.least_area / grid.geometry.cell_area
    cut = two_way_cut(cells, least, config.max_cell) if cells.sum() >= 2 * least else None
    if cut is None:
        return state
    one = convexity((cells,), grid, config.convexity)  # eq. (7)
    two = convexity((cut.first, cut.second), grid, config.convexity)  # eq. (8)
    accepted = is_to_be_cut(one, two, config.convexity)  # eq. (9)
    if accepted:
        centres = [np.argwhere(half).mean(axis=0) for half in (cut.first, cut.second)]
        far = int(np.argmax([np.hypot(*(centre - robot)) for centre in centres]))
        mask = (cut.first, cut.second)[far]
        region = ExtractedRegion(
            state.next_number, np.argwhere(mask) + lattice_corner(grid.geometry)
        )
        state = replace(state, regions=(*state.regions, region), next_number=state.next_number + 1)
    return state.with_entry(
        {
            "event": "extract",
            "t": round(t, 2),
            "c1": round(one, 3),
            "c2": round(two, 3),
            "ncut": round(cut.ncut, 4),
            "cut_width_m": round(cut.width * grid.geometry.resolution, 2),
            "accepted": accepted,
            "reason": "eq. 9 holds" if accepted else "eq. 9 does not hold",
        }
    )


def _without_region_of(
    state: ExtractionState, grid: OccupancyGrid, robot: IntArray
) -> ExtractionState:
    """The state without the region that the robot is back in: its cells are considered again."""
    here = int(painted(state.regions, grid.geometry)[tuple(robot)])
    return replace(state, regions=tuple(r for r in state.regions if r.number != here))
