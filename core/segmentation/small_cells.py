"""Small cells that regions are put together from: cut wherever a region might end."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.mapping import OccupancyGrid
from core.segmentation.automatic import draft_of
from core.segmentation.connected import renumber
from core.segmentation.convex_split import ConvexSplitConfig, split_until_convex
from core.segmentation.draft_cells import DraftConfig
from core.segmentation.label_growth import grown
from core.segmentation.uncluttered import ClutterConfig

LEAST_AREA = 0.4
"""Square metres of a cell; .3 and .2 measured no better."""


@dataclass(frozen=True)
class SmallCellConfig:
    """Parameters of the cells.

    Attributes:
        clutter: what furniture does not part cells.
        draft: constrictions and wall extensions, with smaller cells than rooms are merged from.
        split: draft cells in which more than this is hidden are cut further.
        reach: metres within which floor without a cell joins one.
    """

    clutter: ClutterConfig = field(default_factory=ClutterConfig)
    draft: DraftConfig = field(default_factory=lambda: DraftConfig(least_area=LEAST_AREA))
    split: ConvexSplitConfig = field(
        default_factory=lambda: ConvexSplitConfig(0.1, 400, LEAST_AREA, 0.0)
    )
    reach: float = 1.0


def small_cells(
    floor: BoolArray,
    blocked: BoolArray,
    grid: OccupancyGrid,
    config: SmallCellConfig | None = None,
) -> IntArray:
    """Label image (rows, cols) of the connected cells 1..n of a floor, 0 elsewhere.

    Args:
        floor: free grids that are to be divided.
        blocked: what nobody sees through.
        grid: the map.
        config: parameters.
    """
    config, resolution = config or SmallCellConfig(), grid.geometry.resolution
    if not floor.any():
        return np.zeros(floor.shape, np.int64)
    draft, _ = draft_of(floor, grid.occupied, resolution, config.draft, config.clutter)
    draft = np.where(floor, draft, 0)
    cells, count = np.zeros(floor.shape, np.int64), 0
    for value, box in enumerate(ndimage.find_objects(draft), 1):
        if box is None:
            continue
        pieces, found = ndimage.label(draft[box] == value)
        for piece in range(1, found + 1):
            mask = pieces == piece
            for part in split_until_convex(mask, blocked[box], resolution, config.split, []):
                count += 1
                cells[box][part] = count
    sizes = np.bincount(cells.ravel(), minlength=count + 1) * resolution**2
    cells[(sizes < min(config.draft.least_area, sizes[1:].max(initial=0)))[cells]] = 0
    return renumber(grown(cells, floor, round(config.reach / resolution)))
