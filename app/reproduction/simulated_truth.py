"""The truth of a simulated home in the form that the metrics compare with."""

from __future__ import annotations

from core.evaluation import GroundTruth, aligned, aligned_grid, alignment
from core.evaluation.map_metrics import MapMetrics, map_metrics
from core.evaluation.region_metrics import RegionMetrics, region_metrics
from core.geometry import FloatArray
from core.sensing import RobotLog
from core.simulation import build_home, truth_of
from core.topology import Model


def ground_truth(home: str, drive: RobotLog) -> GroundTruth:
    """The truth of a home, and what of it a drive has explored."""
    truth = truth_of(build_home(home))
    return GroundTruth(
        truth.geometry,
        truth.occupied,
        truth.free,
        truth.explored(drive),
        truth.rooms,
        truth.names,
        truth.door_gaps,
    )


def frame_of(model: Model, drive: RobotLog) -> FloatArray:
    """`pose_truth_map` (3,): one rigid fit of the mapping drive; drift beyond that counts."""
    if drive.truth is None or model.trajectory is None:
        raise ValueError("a model of a drive with truth is needed")
    return alignment(drive.truth, model.trajectory.poses)


def judged(model: Model, drive: RobotLog, truth: GroundTruth) -> tuple[MapMetrics, RegionMetrics]:
    """How good the map and the regions of a model are."""
    frame = frame_of(model, drive)
    geometry = aligned(model.grid.geometry, frame)
    return (
        map_metrics(aligned_grid(model.grid, frame), truth),
        region_metrics(model.regions, geometry, truth),
    )
