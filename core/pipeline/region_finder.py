"""From a map, and the drive that made it, to regions and suggested rooms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from core.geometry import BoolArray, IntArray
from core.mapping import OccupancyGrid
from core.mapping.map_result import MapResult
from core.pipeline.floor import floor_of_drive, restricted
from core.pipeline.growing_model import METHODS, GrowingModel, MethodName, grown_along
from core.pipeline.mapper import MappingOptions
from core.progress import Progress, no_progress, part_of
from core.segmentation.automatic import AutomaticConfig, segment_automatically, segment_rooms
from core.segmentation.latest_regions import region_image
from core.segmentation.offline import OfflineConfig, segment_offline
from core.segmentation.paper_config import PaperConfig
from core.sensing import RobotLog, Trajectory
from core.topology.rooms import suggested_rooms

DRIVE_SHARE = 0.8
"""Share of the time that the steps along the drive take, for the progress."""


@dataclass(frozen=True)
class FoundRegions:
    """What a segmentation found.

    Attributes:
        regions: (rows, cols) label image.
        rooms: (rows, cols) label image of suggested rooms.
        history: the decisions in order.
        parameters: every parameter, for the provenance.
        node_ids: ids that regions have from the drive, by their value.
        next_number: the first number that no id has used.
        timeline: a picture (`StepPicture` as PNG) of every step along the drive.
        came_from: ids of the nodes that a region was cut from or joined of along the drive.
    """

    regions: IntArray
    rooms: IntArray
    history: tuple[Mapping[str, Any], ...]
    parameters: Mapping[str, Any]
    node_ids: Mapping[int, str]
    next_number: int = 1
    timeline: tuple[bytes, ...] = ()
    came_from: Mapping[int, tuple[str, ...]] = field(default_factory=dict)


def given_number(
    grid: OccupancyGrid, floor: BoolArray, k: int, seed: int, progress: Progress
) -> FoundRegions:
    """Offline with k given (3.1); rooms as the automatic segmentation sees them."""
    config = OfflineConfig()
    regions = segment_offline(floor, k, seed, config)
    progress(0.5, "grouping regions into rooms")
    rooms = segment_rooms(restricted(grid, floor))
    history = ({"event": "offline", "regions": k, "seed": seed},)
    return FoundRegions(regions, rooms, history, asdict(config), {})


def number_found(
    grid: OccupancyGrid, floor: BoolArray, seed: int, progress: Progress
) -> FoundRegions:
    """Offline, the number of regions found by convexity."""
    config = AutomaticConfig()
    found = segment_automatically(restricted(grid, floor), config, seed, progress)
    return FoundRegions(found.regions, found.rooms, found.history, asdict(config), {})


def along_the_drive(
    log: RobotLog,
    trajectory: Trajectory,
    whole: MapResult,
    mapping: MappingOptions,
    method: MethodName,
    progress: Progress,
) -> FoundRegions:
    """Autonomous extraction (3.2): a fold over the drive, then what is left at its end.

    Args:
        log: the drive.
        trajectory: its poses.
        whole: the map of all scans.
        mapping: how maps are made on the way.
        method: how regions are extracted.
        progress: told all along.
    """
    drive = part_of(progress, 0.0, DRIVE_SHARE)
    growing = grown_along(log, trajectory, mapping, METHODS[method], drive)
    return found_so_far(growing, whole)


def found_so_far(growing: GrowingModel, whole: MapResult | None = None) -> FoundRegions:
    """The regions of a drive as if it ended now; they keep the numbers they were extracted with.

    In the paper's method every region is a room of its own: it knows no rooms above its nodes.

    Args:
        growing: the drive so far; it can go on.
        whole: the map of all scans, by default the one that the drive has grown.
    """
    whole = whole or growing.whole_map()
    floor = floor_of_drive(whole, growing.trajectory)
    grid = restricted(whole.grid, floor)
    moment = growing.moment(replace(whole, grid=grid))
    state = growing.finished(moment)
    regions = region_image(state, grid)
    if floor.any() and not regions.any():
        return number_found(whole.grid, floor, 0, no_progress)
    by_method = isinstance(growing.method.config, PaperConfig)
    rooms = regions if by_method else suggested_rooms(regions, moment.rooms)
    node_ids = {int(value): f"n{value}" for value in np.unique(regions) if value > 0}
    parameters = asdict(growing.method.config)
    came_from = {r.number: tuple(f"n{parent}" for parent in r.parents) for r in state.regions}
    return FoundRegions(
        regions,
        rooms,
        state.history,
        parameters,
        node_ids,
        state.next_number,
        state.pictures,
        came_from,
    )
