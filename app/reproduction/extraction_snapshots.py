"""The autonomous extraction seen at moments of the drive (Fig. 14 a-c)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray, IntArray, travelled
from core.mapping import OccupancyGrid
from core.pipeline.growing_model import METHODS, GrowingModel
from core.pipeline.mapper import MappingOptions, map_log
from core.progress import Progress, no_progress
from core.segmentation.latest_regions import region_image
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
        shares: of the drive's length, after which to look.
    """
    mapping = MappingOptions()
    growing = GrowingModel(log.ring, mapping, METHODS["paper" if as_in_paper else "default"])
    driven = travelled(trajectory.poses)
    looks = {int(np.searchsorted(driven, share * driven[-1])) for share in shares}
    found = []
    for i in range(max(looks, default=-1) + 1):
        growing.add(log.scan(i), trajectory.poses[i])
        if i in looks:
            part = np.arange(i + 1)
            grid = map_log(log.taken(part), trajectory.taken(part), mapping).grid
            regions = region_image(growing.state, grid, 0.0)
            found.append(Snapshot(float(log.t[i]), grid, regions, trajectory.poses[i]))
            progress(len(found) / len(looks), "extracting regions along the drive")
    return tuple(found)
