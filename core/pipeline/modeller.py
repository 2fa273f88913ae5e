"""The modeller: a drive or a map in, a model (regions, topology, rooms) out."""

from __future__ import annotations

import platform
from dataclasses import asdict, dataclass, field, replace
from importlib.metadata import PackageNotFoundError, version
from typing import Any, Literal

import numpy as np

from core.errors import InputError, MapError, UsageError
from core.mapping import OccupancyGrid
from core.mapping.drift_edits import DriftEdits
from core.mapping.occupancy_grid import DEFAULT_RESOLUTION
from core.mapping.odometry_calibration import OdometryCalibration
from core.pipeline.corrected_drive import corrected_drive
from core.pipeline.drift_review import drift_view
from core.pipeline.floor import floor_of_drive, large_parts
from core.pipeline.growing_model import GrowingModel, MethodName
from core.pipeline.mapper import MappingMethod, MappingOptions, map_log
from core.pipeline.odometry import OdometryChoice
from core.pipeline.region_finder import (
    FoundRegions,
    along_the_drive,
    found_so_far,
    given_number,
    number_found,
)
from core.progress import Progress, no_progress, part_of
from core.segmentation.connected import largest_component
from core.sensing import RobotLog, Trajectory
from core.topology import Model
from core.topology.continuation import going_on
from core.topology.labels import room_image
from core.topology.topology_of import topology_of

Mode = Literal["autonomous", "offline"]
DRIFT_SHARE, MAPPING_SHARE, CUTTING_SHARE = 0.35, 0.45, 0.95
"""Shares of the time after which trajectory, map and regions are there, for the progress."""
PAPER_NEEDS_NUMBER = "the paper's offline method needs the number of regions: give one"
SMALLEST_PART = 1.0
"""Square metres of a separate part of an imported map that is modelled."""


@dataclass(frozen=True)
class ModellingOptions:
    """What a user chooses for a model; what cannot be is refused when it is made.

    Attributes:
        mode: autonomous (3.2) or offline (3.1); by default autonomous without a number of regions.
        method: our default or the paper's method as written.
        regions: number of regions, offline only; None when it is to be found.
        mapping: mapping method.
        odometry: which trajectory the map is made at.
        resolution: metres per cell.
        seed: of everything that is drawn.
        edits: what a person says about the drift of the drive.
        known: the calibration of the robot's odometry from an earlier drive.
    """

    mode: Mode | None = None
    method: MethodName = "default"
    regions: int | None = None
    mapping: MappingMethod = "cemal"
    odometry: OdometryChoice = "corrected"
    resolution: float = DEFAULT_RESOLUTION
    seed: int = 0
    edits: DriftEdits = field(default_factory=DriftEdits)
    known: OdometryCalibration | None = None

    def __post_init__(self) -> None:
        if self.mode == "autonomous" and self.regions is not None:
            raise UsageError(
                "autonomous modelling finds the number of regions itself: leave the number away "
                "or choose mode offline"
            )
        if self.regions is not None and self.regions < 1:
            raise InputError(f"{self.regions} regions cannot be made: choose a number from 1")
        if self.method == "paper" and self.mode == "offline" and self.regions is None:
            raise UsageError(PAPER_NEEDS_NUMBER)
        MappingOptions(self.mapping, self.resolution)


def model_log(
    log: RobotLog,
    options: ModellingOptions | None = None,
    progress: Progress = no_progress,
    previous: Model | None = None,
) -> Model:
    """Models a home from a drive through it.

    Args:
        log: the drive; its truth is not looked at.
        options: what the user chose.
        progress: told all along.
        previous: an earlier model of the same drive, whose ids and labels go along by overlap.

    Raises:
        InputError: the log cannot be modelled so.
    """
    options = options or ModellingOptions()
    whole = log
    drive = corrected_drive(
        log, options.odometry, part_of(progress, 0.0, DRIFT_SHARE), options.edits, options.known
    )
    log, trajectory = drive.log, drive.trajectory
    mapping = MappingOptions(options.mapping, options.resolution)
    result = map_log(log, trajectory, mapping, part_of(progress, DRIFT_SHARE, MAPPING_SHARE))
    grid, rest = result.grid, part_of(progress, MAPPING_SHARE, CUTTING_SHARE)
    floor = floor_of_drive(result, trajectory)
    if options.regions is not None:
        found = given_number(grid, floor, options.regions, options.seed, rest)
    elif options.mode == "offline":
        found = number_found(grid, floor, options.seed, rest)
    else:
        found = along_the_drive(log, trajectory, result, mapping, options.method, rest)
    source = {
        "log": whole.name,
        "scans": len(whole),
        "duration_s": round(whole.duration_s, 3),
        "distance_m": round(whole.distance_m, 3),
    }
    provenance = {
        "inputs": [source],
        "odometry": drive.provenance(),
        "mapping": mapping.parameters(),
    }
    progress(CUTTING_SHARE, "finding doorways")
    model = _model(grid, found, drive.whole.trajectory, options, provenance, previous)
    return replace(model, drift=drift_view(drive, grid, mapping, options.edits))


def model_so_far(
    name: str,
    growing: GrowingModel,
    options: ModellingOptions,
    previous: Model | None = None,
) -> Model:
    """The model of a drive that has not ended, as if it ended now.

    Args:
        name: of the drive.
        growing: the drive so far.
        options: what it is modelled with.
        previous: an earlier model of the same drive, whose ids and labels go along by overlap.

    Raises:
        MapError: the sonar has not heard anything yet.
    """
    whole, trajectory = growing.whole_map(), growing.trajectory
    if not whole.kept.any():
        raise MapError(f"drive {name!r} has no usable echo yet: there is nothing to map")
    found = found_so_far(growing, whole)
    span = float(trajectory.t[-1] - trajectory.t[0])
    source = {"log": name, "scans": len(trajectory), "duration_s": round(span, 3)}
    provenance = {
        "inputs": [source | {"distance_m": round(growing.driven, 3)}],
        "odometry": {"used": options.odometry},
        "mapping": MappingOptions(options.mapping, options.resolution).parameters(),
    }
    return _model(whole.grid, found, trajectory, options, provenance, previous)


def model_map(
    grid: OccupancyGrid,
    options: ModellingOptions | None = None,
    progress: Progress = no_progress,
    previous: Model | None = None,
) -> Model:
    """Models a home from a map that another program made (offline, 3.1).

    Raises:
        UsageError: autonomous modelling, which needs a drive; the paper's method without a number.
        InputError: the map cannot be modelled so.
    """
    options = options or ModellingOptions(mode="offline")
    if options.mode == "autonomous":
        raise UsageError("autonomous modelling needs a log: a map tells nothing of the drive")
    if options.method == "paper" and options.regions is None:
        raise UsageError(PAPER_NEEDS_NUMBER)
    if not grid.free.any():
        raise MapError("the map has no free space to divide")
    cutting = part_of(progress, 0.0, CUTTING_SHARE)
    if options.regions is not None:
        floor = largest_component(grid.free)
        found = given_number(grid, floor, options.regions, options.seed, cutting)
    else:
        floor = large_parts(grid.free, round(SMALLEST_PART / grid.geometry.cell_area))
        floor = floor if floor.any() else largest_component(grid.free)
        found = number_found(grid, floor, options.seed, cutting)
    provenance = {"inputs": [{"map": list(grid.geometry.shape)}]}
    progress(CUTTING_SHARE, "finding doorways")
    return _model(grid, found, None, options, provenance, previous)


def _model(
    grid: OccupancyGrid,
    found: FoundRegions,
    trajectory: Trajectory | None,
    options: ModellingOptions,
    provenance: dict[str, Any],
    previous: Model | None,
) -> Model:
    topology = topology_of(
        grid,
        found.regions,
        found.rooms,
        node_ids=found.node_ids,
        next_number=found.next_number,
        came_from=found.came_from,
    )
    provenance |= {
        "options": asdict(options),
        "segmentation": found.parameters,
        "versions": _versions(),
    }
    model = Model(
        grid,
        found.regions,
        room_image(found.regions, topology),
        topology,
        trajectory,
        provenance,
        found.history,
        found.timeline,
    )
    return going_on(model, previous) if previous else model


def _versions() -> dict[str, str]:
    """The versions that made a model."""
    try:
        own = version("echorooms")
    except PackageNotFoundError:
        own = "unknown"
    return {"echorooms": own, "numpy": np.__version__, "python": platform.python_version()}
