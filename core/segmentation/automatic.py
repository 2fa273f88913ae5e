"""Offline segmentation of any map, the number of regions found: rooms first, then convex nodes.

Draft cells merge across the border that is least likely one of two rooms (`merging.py`,
`boundary_model.py`) until all is one; rooms are those regions on the way that make the best rooms
together (`merge_tree.py`, `room_model.py`). Each room is then cut by normalized cuts until every part
is convex in the sense of hidden pairs (`convex_split.py`). So a room is a union of regions by
construction, and what counts as a doorway is judged once for both.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy import ndimage

from core.errors import MapError
from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping import OccupancyGrid
from core.progress import Progress, no_progress, part_of
from core.segmentation.boundary_model import BoundaryModel, stored_boundary_model
from core.segmentation.boundary_shape import Surroundings
from core.segmentation.connected import renumber
from core.segmentation.convex_split import ConvexSplitConfig, split_until_convex
from core.segmentation.draft_cells import DraftConfig, clearance_of, draft_cells
from core.segmentation.main_axis import main_axis
from core.segmentation.map_character import map_character
from core.segmentation.merge_tree import merge_tree
from core.segmentation.merging import RegionGraph, judged
from core.segmentation.mutual_visibility import sight_blockers
from core.segmentation.room_model import RoomModel, stored_room_model
from core.segmentation.uncluttered import ClutterConfig, uncluttered

BARE = ClutterConfig(largest_obstacle=1.5, least_floor=0.0)
"""A floor without tables and shelves that stand alone (m2), on which passages are measured again."""
ROOMS_SHARE = 0.7
"""Share of the time that goes into the rooms, for the progress."""

LIKELY = "likely the border of two rooms"
UNLIKELY = "an unlikely border, but both sides make better rooms than they would make together"
"""Why a border between two rooms stays."""


@dataclass(frozen=True)
class RoomJudges:
    """What was learned about rooms: the border model and the room model."""

    border: BoundaryModel
    room: RoomModel


def stored_judges() -> RoomJudges:
    """Those that come with the program."""
    return RoomJudges(stored_boundary_model(), stored_room_model())


@dataclass(frozen=True)
class AutomaticConfig:
    """Parameters of automatic segmentation.

    Attributes:
        clutter, draft, convex: of the stages.
    """

    clutter: ClutterConfig = field(default_factory=ClutterConfig)
    draft: DraftConfig = field(default_factory=DraftConfig)
    convex: ConvexSplitConfig = field(default_factory=ConvexSplitConfig)


@dataclass(frozen=True)
class Segmentation:
    """Regions and suggested rooms of a map.

    Attributes:
        regions: (rows, cols) region 1..n of each cell, 0 = none.
        rooms: (rows, cols) room 1..m of each cell, 0 = none; every region lies in one room.
        history: the decisions in order.
    """

    regions: IntArray
    rooms: IntArray
    history: tuple[dict[str, Any], ...]


def segment_automatically(
    grid: OccupancyGrid,
    config: AutomaticConfig | None = None,
    seed: int = 0,
    progress: Progress = no_progress,
    judges: RoomJudges | None = None,
) -> Segmentation:
    """Finds regions and rooms of a map.

    Args:
        grid: the map.
        config: parameters.
        seed: of the drawn pairs of points.
        progress: told all along.
        judges: of borders and rooms; by default those that come with the program.

    Raises:
        MapError: there is no free space.
    """
    config = config or AutomaticConfig()
    resolution = grid.geometry.resolution
    progress(0.0, "looking for rooms")
    rooms, floor, history = _rooms_and_floor(grid, config, judges)
    # Small lone obstacles are floor, but a wall in pieces hides.
    blocked = ~floor | sight_blockers(grid)
    rest = part_of(progress, ROOMS_SHARE, 1.0)
    regions = _nodes(rooms, blocked, resolution, config.convex, history, seed, rest)
    filled = ~grid.free
    rooms[filled], regions[filled] = 0, 0
    return Segmentation(renumber(regions), renumber(rooms), tuple(history))


def segment_rooms(
    grid: OccupancyGrid, config: AutomaticConfig | None = None, judges: RoomJudges | None = None
) -> IntArray:
    """Label image (rows, cols) of the rooms 1..m alone, 0 = none.

    Args, raises: as for `segment_automatically`.
    """
    rooms, _, _ = _rooms_and_floor(grid, config or AutomaticConfig(), judges)
    rooms[~grid.free] = 0
    return renumber(rooms)


def _rooms_and_floor(
    grid: OccupancyGrid, config: AutomaticConfig, judges: RoomJudges | None
) -> tuple[IntArray, BoolArray, list[dict[str, Any]]]:
    """Rooms, the floor that they share out (the map's and what is filled in), and the history."""
    if not grid.free.any():
        raise MapError("the map has no free space to divide")
    resolution = grid.geometry.resolution
    cells, around = draft_of(grid.free, grid.occupied, resolution, config.draft, config.clutter)
    rooms, history = _rooms(cells, around, judges or stored_judges())
    return rooms, around.floor, history


def draft_of(
    free: BoolArray,
    occupied: BoolArray,
    resolution: float,
    config: DraftConfig,
    clutter: ClutterConfig,
) -> tuple[IntArray, Surroundings]:
    """Draft cells of free space and what their borders are measured on."""
    floor = uncluttered(free, resolution, clutter)
    wall = np.asarray(ndimage.binary_dilation(occupied & ~floor, np.ones((3, 3))) & ~floor)
    axis = main_axis(wall)
    clearance = clearance_of(floor, resolution)
    cells = draft_cells(floor, clearance, resolution, config)
    bare = uncluttered(floor, resolution, BARE)
    character = map_character(free, floor, bare, resolution)
    wide = clearance_of(bare, resolution)
    return cells, Surroundings(floor, wall, clearance, wide, axis, resolution, character)


def _rooms(
    cells: IntArray, around: Surroundings, judges: RoomJudges
) -> tuple[IntArray, list[dict[str, Any]]]:
    """Label image of the rooms, and the borders between them for the history."""

    def judge(_: list[tuple[int, int]], features: FloatArray) -> FloatArray:
        return judges.border.log_odds(features)

    rooms = RegionGraph(cells, around)
    judged(rooms, rooms.pairs(), judge)
    tree = merge_tree(rooms.copy(), judge)
    for kept, gone in tree.mergers(tree.best(judges.room.worth(tree.features))):
        rooms.join(kept, gone)
    history: list[dict[str, Any]] = []
    for odds, (a, b) in judged(rooms, rooms.pairs(), judge):
        border = rooms.borders[a][b]
        history.append(
            {
                "event": "room border",
                "middle_cell": [round(float(v), 1) for v in border.points.mean(axis=0)],
                "width_m": round(border.shape.length, 2),
                "log_odds": round(odds, 2),
                "accepted": True,
                "reason": UNLIKELY if odds < 0 else LIKELY,
            }
        )
    return np.asarray(rooms.parent[cells]), history


def _nodes(
    rooms: IntArray,
    blocked: BoolArray,
    resolution: float,
    config: ConvexSplitConfig,
    history: list[dict[str, Any]],
    seed: int,
    progress: Progress,
) -> IntArray:
    """Label image of the rooms' convex parts."""
    regions = np.zeros(rooms.shape, np.int64)
    boxes = ndimage.find_objects(rooms)
    count = 0
    for value, box in enumerate(boxes, start=1):
        if box is None:
            continue
        room = rooms[box] == value
        for part in split_until_convex(room, blocked[box], resolution, config, history, seed):
            count += 1
            regions[box][part] = count
        progress(value / len(boxes), "cutting rooms into convex regions")
    return regions
