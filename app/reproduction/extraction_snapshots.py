"""The autonomous extraction seen at moments of the drive (Fig. 14 a-c)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray, IntArray
from core.mapping import OccupancyGrid
from core.pipeline.growing_map import moments_along, stops_along
from core.pipeline.mapper import MappingOptions, map_log
from core.pipeline.region_finder import PAPER_STEP, PAPER_WINDOW
from core.progress import Progress, no_progress
from core.segmentation.autonomous import AutonomousConfig, extract, region_image
from core.segmentation.extraction_state import ExtractionState
from core.segmentation.paper_extraction import PaperConfig, extract_as_in_paper
from core.sensing import RobotLog, Trajectory

SHARES = (0.25, 0.5, 0.75)
"""Shares of the drive that are looked at; the end is the model itself."""


@dataclass(frozen=True)
class Snapshot:
    """The map so far (grid), its extracted regions (rows, cols; 0 = not extracted) and the robot."""

    t: float
    grid: OccupancyGrid
    regions: IntArray
    pose: FloatArray


def snapshots(
    log: RobotLog,
    trajectory: Trajectory,
    as_in_paper: bool,
    shares: tuple[float, ...] = SHARES,
    progress: Progress = no_progress,
) -> tuple[Snapshot, ...]:
    """Runs the extraction along a drive, as the modeller does, and looks at it now and then.

    Args:
        log: the mapping drive.
        trajectory: its poses.
        as_in_paper: eq. (5)-(9) on local maps; otherwise our default.
        shares: of the drive's steps, after which to look.
    """
    options = MappingOptions()
    step = PAPER_STEP if as_in_paper else AutonomousConfig().step
    stops = stops_along(trajectory, step)
    looks = (
        {int(stops[round(share * (len(stops) - 1))]) for share in shares} if len(stops) else set()
    )
    state, found = ExtractionState(), []
    stops = stops[stops <= max(looks, default=-1)]
    window = PAPER_WINDOW if as_in_paper else None
    for i, moment in enumerate(moments_along(log, trajectory, options, stops, window)):
        if as_in_paper:
            state = extract_as_in_paper(state, moment, PaperConfig())
        else:
            state = extract(state, moment, AutonomousConfig())
        if int(stops[i]) in looks:
            part = np.arange(stops[i] + 1)
            grid = map_log(log.taken(part), trajectory.taken(part), options).grid
            found.append(Snapshot(moment.t, grid, region_image(state, grid, 0.0), moment.pose))
        progress((i + 1) / len(stops), "extracting regions along the drive")
    return tuple(found)
