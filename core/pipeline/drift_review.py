"""A drive before and after its correction, to be looked at side by side."""

from __future__ import annotations

import io
from dataclasses import asdict
from typing import Any

import numpy as np
from PIL import Image

from core.errors import MapError
from core.geometry import FloatArray, IntArray
from core.mapping import OccupancyGrid
from core.mapping.drift_edits import DriftEdits
from core.mapping.drift_view import DriftView
from core.mapping.map_server import trinary
from core.pipeline.corrected_drive import CorrectedDrive
from core.pipeline.growing_model import apart
from core.pipeline.mapper import MappingOptions, map_scans
from core.sensing import RobotLog, Trajectory


def drift_view(
    drive: CorrectedDrive, corrected: OccupancyGrid, mapping: MappingOptions, edits: DriftEdits
) -> DriftView:
    """What is kept of a drive that was modelled.

    Args:
        drive: its scans and poses.
        corrected: its map.
        mapping: how the map was made.
        edits: what a person said about it.
    """
    keys = key_scans(drive.log.odometry)
    log = drive.log.taken(keys)
    rows = np.column_stack((log.t, drive.trajectory.poses[keys], log.odometry))
    before = _odometry_map(log, mapping)
    report = {
        "edits": asdict(edits),
        "trajectory": np.round(rows, 4).tolist(),
        "map": _place(corrected),
        "odometry_map": None if before is None else _place(before),
    }
    return DriftView(report, None if before is None else _png(before))


def key_scans(odometry: FloatArray) -> IntArray:
    """Indices of the scans (N, 3 poses) that tell something new, the last one among them.

    A map of these is as good as one of all.
    """
    keys = [0]
    for i in range(1, len(odometry)):
        if apart(odometry[i], odometry[keys[-1]]) or i == len(odometry) - 1:
            keys.append(i)
    return np.array(keys, np.int64)


def _odometry_map(log: RobotLog, mapping: MappingOptions) -> OccupancyGrid | None:
    """The map at the odometry as it is; None where its jumps make that too large."""
    try:
        return map_scans(log, Trajectory.from_odometry(log), mapping).grid
    except MapError:
        return None


def _place(grid: OccupancyGrid) -> dict[str, Any]:
    geometry = grid.geometry
    return {
        "origin": list(geometry.origin),
        "resolution": geometry.resolution,
        "shape": list(geometry.shape),
    }


def _png(grid: OccupancyGrid) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(trinary(grid))).save(buffer, "PNG")
    return buffer.getvalue()
