"""From a map, and the drive that made it, to regions and suggested rooms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.mapping import FREE, UNKNOWN, OccupancyGrid
from core.mapping.map_result import MapResult
from core.pipeline.growing_map import last_moment, moments_along, stops_along
from core.pipeline.mapper import MappingOptions
from core.progress import Progress, part_of
from core.segmentation.automatic import AutomaticConfig, segment_automatically
from core.segmentation.autonomous import AutonomousConfig, extract, finish, region_image
from core.segmentation.extraction_state import ExtractionState
from core.segmentation.offline import OfflineConfig, segment_offline
from core.segmentation.paper_extraction import (
    PaperConfig,
    extract_as_in_paper,
    finish_as_in_paper,
)
from core.sensing import RobotLog, Trajectory
from core.topology.rooms import suggested_rooms

PAPER_STEP, PAPER_WINDOW = 2.5, 12.0
"""Metres of travel between two steps of the paper's extraction, which names none, and in its local
map: a sliding window of about 12 m measured better than all data in two of three homes."""
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
    """

    regions: IntArray
    rooms: IntArray
    history: tuple[Mapping[str, Any], ...]
    parameters: Mapping[str, Any]
    node_ids: Mapping[int, str]
    next_number: int = 1
    timeline: tuple[bytes, ...] = ()


def given_number(
    grid: OccupancyGrid, floor: BoolArray, k: int, seed: int, progress: Progress
) -> FoundRegions:
    """Offline with k given (3.1); rooms as the automatic segmentation sees them."""
    config = OfflineConfig()
    regions = segment_offline(floor, k, seed, config)
    progress(0.5, "grouping regions into rooms")
    rooms = segment_automatically(restricted(grid, floor), seed=seed).rooms
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
    progress: Progress,
) -> FoundRegions:
    """Autonomous extraction (3.2): a fold over the drive, then what is left at its end."""
    config = AutonomousConfig()
    state = ExtractionState()
    stops = stops_along(trajectory, config.step)
    drive = part_of(progress, 0.0, DRIVE_SHARE)
    for i, moment in enumerate(moments_along(log, trajectory, mapping, stops)):
        state = extract(state, moment, config)
        drive((i + 1) / len(stops), "extracting regions along the drive")
    state = finish(state, last_moment(trajectory, whole), config)
    regions = region_image(state, whole.grid)
    if not regions.any():
        return number_found(whole.grid, whole.grid.free, 0, part_of(progress, DRIVE_SHARE, 1.0))
    return _of_state(state, regions, suggested_rooms(whole.grid, regions), asdict(config))


def along_the_drive_as_in_paper(
    log: RobotLog,
    trajectory: Trajectory,
    whole: MapResult,
    mapping: MappingOptions,
    progress: Progress,
) -> FoundRegions:
    """Autonomous extraction by eq. (5)-(9) on local maps; what is left at the end becomes regions.

    Every region is a room of its own: the paper knows no rooms above its nodes.
    """
    config = PaperConfig()
    state = ExtractionState()
    stops = stops_along(trajectory, PAPER_STEP)
    drive = part_of(progress, 0.0, DRIVE_SHARE)
    for i, moment in enumerate(moments_along(log, trajectory, mapping, stops, PAPER_WINDOW)):
        state = extract_as_in_paper(state, moment, config)
        drive((i + 1) / len(stops), "extracting regions along the drive")
    state = finish_as_in_paper(state, last_moment(trajectory, whole), config)
    regions = region_image(state, whole.grid)
    return _of_state(state, regions, regions, asdict(config))


def _of_state(
    state: ExtractionState, regions: IntArray, rooms: IntArray, parameters: Mapping[str, Any]
) -> FoundRegions:
    """The result of a drive; regions keep the numbers that they were extracted with."""
    node_ids = {int(value): f"n{value}" for value in np.unique(regions) if value > 0}
    return FoundRegions(
        regions, rooms, state.history, parameters, node_ids, state.next_number, state.pictures
    )


def restricted(grid: OccupancyGrid, floor: BoolArray) -> OccupancyGrid:
    """The grid with the free cells outside the floor taken as unknown."""
    state = np.where((grid.state == FREE) & ~floor, UNKNOWN, grid.state).astype(np.uint8)
    return OccupancyGrid(grid.geometry, state)


def large_parts(free: BoolArray, least_cells: int) -> BoolArray:
    """The connected parts of free space of at least so many cells, together."""
    labels, _ = ndimage.label(free)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    return np.asarray((sizes >= max(1, least_cells))[labels])
