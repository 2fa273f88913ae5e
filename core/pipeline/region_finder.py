"""From a map, and the drive that made it, to regions and suggested rooms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.mapping import FREE, UNKNOWN, OccupancyGrid
from core.pipeline.growing_map import maps_along, stops_along
from core.pipeline.mapper import MappingOptions
from core.progress import Progress, part_of
from core.segmentation.automatic import AutomaticConfig, segment_automatically
from core.segmentation.autonomous import AutonomousConfig, extract, finish, region_image
from core.segmentation.extraction_state import ExtractionState
from core.segmentation.offline import OfflineConfig, segment_offline
from core.sensing import RobotLog, Trajectory

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
    """

    regions: IntArray
    rooms: IntArray
    history: tuple[Mapping[str, Any], ...]
    parameters: Mapping[str, Any]
    node_ids: Mapping[int, str]
    next_number: int = 1


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
    grid: OccupancyGrid,
    floor: BoolArray,
    mapping: MappingOptions,
    progress: Progress,
) -> FoundRegions:
    """Autonomous extraction (3.2): a fold over the drive, then what is left at its end."""
    config = AutonomousConfig()
    state = ExtractionState()
    stops = stops_along(trajectory, config.step)
    drive = part_of(progress, 0.0, DRIVE_SHARE)
    for i, (stop, map_so_far) in enumerate(maps_along(log, trajectory, mapping, stops)):
        pose, t = trajectory.poses[stop], float(log.t[stop])
        state = extract(state, map_so_far, pose, t, config)
        drive((i + 1) / len(stops), "extracting regions along the drive")
    whole = restricted(grid, floor)
    state = finish(state, whole, trajectory.poses[-1], float(log.t[-1]), config)
    regions = region_image(state, whole)
    if not regions.any():
        return number_found(grid, floor, 0, part_of(progress, DRIVE_SHARE, 1.0))
    rooms = segment_automatically(whole, config.automatic).rooms
    values = [int(value) for value in np.unique(regions) if value > 0]
    node_ids = {value: f"n{value}" for value in values}
    return FoundRegions(regions, rooms, state.history, asdict(config), node_ids, state.next_number)


def restricted(grid: OccupancyGrid, floor: BoolArray) -> OccupancyGrid:
    """The grid with the free cells outside the floor taken as unknown."""
    state = np.where((grid.state == FREE) & ~floor, UNKNOWN, grid.state).astype(np.uint8)
    return OccupancyGrid(grid.geometry, state)


def large_parts(free: BoolArray, least_cells: int) -> BoolArray:
    """The connected parts of free space of at least so many cells."""
    labels, _ = ndimage.label(free)
    sizes = np.bincount(labels.ravel())
    sizes[0] = 0
    return np.asarray((sizes >= least_cells)[labels])
