"""Metrics for maps, regions, rooms and trajectories, all against ground truth."""

from core.evaluation.ground_truth import GroundTruth, aligned, aligned_grid, alignment
from core.evaluation.map_metrics import MapMetrics, map_metrics
from core.evaluation.region_metrics import RegionMetrics, region_metrics
from core.evaluation.room_metrics import RoomMetrics, room_metrics
from core.evaluation.trajectory_error import TrajectoryError, trajectory_error

__all__ = [
    "GroundTruth",
    "MapMetrics",
    "RegionMetrics",
    "RoomMetrics",
    "TrajectoryError",
    "aligned",
    "aligned_grid",
    "alignment",
    "map_metrics",
    "region_metrics",
    "room_metrics",
    "trajectory_error",
]
