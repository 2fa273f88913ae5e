"""Drift correction: a drive in, a better trajectory out, by sonar alone.

1. Reflecting points of all readings, by local odometry (reflection_points).
2. Along the drive, a node every 1.5 m of travel. Each node's local map of about 7 m is matched with
   earlier ones that the pose graph says may overlap (loop_closure), and tells the direction of the walls
   around it (wall_direction); the graph is solved again after each node, so that the next search is small.
3. With the drift gone, all visits of each surface are aligned with each other (point_alignment).

Everything is anchored at the first pose and deterministic.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from core.geometry import FloatArray, IntArray
from core.mapping.graph_terms import Link
from core.mapping.loop_closure import Closure, ClosureConfig, close_loops
from core.mapping.odometry_calibration import OdometryCalibration
from core.mapping.odometry_model import OdometryNoise, through_nodes, without_systematic_error
from core.mapping.point_alignment import AlignmentConfig, align
from core.mapping.pose_graph import GraphConfig, PoseGraph
from core.mapping.reflection_points import (
    ReflectionConfig,
    ReflectionPoints,
    path_length,
    reflection_points,
)
from core.mapping.scan_matching import (
    MatchingConfig,
    Submap,
    points_from,
    points_of_stretch,
    submap,
)
from core.mapping.wall_direction import WallDirectionConfig, wall_direction, wrap_quarter
from core.progress import Progress, no_progress
from core.sensing.robot_log import RobotLog
from core.sensing.trajectory import Trajectory


@dataclass(frozen=True)
class DriftConfig:
    """Parameters of the whole; those of the stages sit beside them.

    Attributes:
        spacing: travel between two nodes (m).
        half_span: a submap reaches this many nodes, and a half, to both sides.
        apart: nodes at least this far apart are tried against each other.
        wall_span: travel before and after a node from which its walls are seen (m).
        aligned_wall_sigma: standard deviation of a wall direction while visits are aligned (rad): the
            nodes are denser then, and see the same walls more often.
        use_walls: the walls' directions count (the Manhattan assumption).
        kept_closure_weight: share of its information that a closure keeps while visits are aligned,
            which says the same more sharply.
        refinement: nodes per `spacing` while visits are aligned.
    """

    spacing: float = 1.5
    half_span: int = 2
    apart: int = 6
    wall_span: float = 5.0
    aligned_wall_sigma: float = math.radians(3.75)
    use_walls: bool = True
    kept_closure_weight: float = 0.05
    refinement: int = 2
    reflection: ReflectionConfig = field(default_factory=ReflectionConfig)
    matching: MatchingConfig = field(default_factory=MatchingConfig)
    closure: ClosureConfig = field(default_factory=ClosureConfig)
    walls: WallDirectionConfig = field(default_factory=WallDirectionConfig)
    graph: GraphConfig = field(default_factory=GraphConfig)
    alignment: AlignmentConfig = field(default_factory=AlignmentConfig)
    noise: OdometryNoise = field(default_factory=OdometryNoise)


@dataclass(frozen=True)
class DriftResult:
    """What the correction found.

    Attributes:
        trajectory: corrected, with standard deviations against the first pose.
        calibration: the systematic part.
        closures: all pairs that were tried, accepted or not.
        nodes: (K,) scans at which the graph has nodes.
    """

    trajectory: Trajectory
    calibration: OdometryCalibration
    closures: tuple[Closure, ...]
    nodes: IntArray


def correct_drift(
    log: RobotLog, config: DriftConfig | None = None, progress: Progress = no_progress
) -> DriftResult:
    """The corrected trajectory of a drive whose odometry does not break off.

    Args:
        log: the drive; at least two scans. See `odometry_breaks` for jumps and carried robots.
        config: parameters.
        progress: told after each node.
    """
    config = config or DriftConfig()
    length = path_length(log.odometry, config.reflection.metres_per_radian)
    nodes = _nodes(length, config.spacing)
    graph = PoseGraph(log.odometry, nodes, config.noise, config.graph)
    closures = _follow(graph, log, length, config, progress)
    graph.solve()
    calibration = OdometryCalibration.of(graph.error, graph.error_sigma())
    coarse = through_nodes(log.odometry, length, nodes, graph.poses)
    progress(0.8, "aligning visits")
    poses = _align(graph, log, coarse, length, config) if graph.links else coarse
    trajectory = _with_sigmas(log, length, graph, poses)
    progress(1.0, "aligning visits")
    return DriftResult(trajectory, calibration, tuple(closures), nodes)


def _nodes(length: FloatArray, spacing: float) -> IntArray:
    """Scans every `spacing` metres of travel, the first and the last among them."""
    count = max(2, round(float(length[-1]) / spacing) + 1)
    at = np.searchsorted(length, np.linspace(0.0, length[-1], count) - 1e-9)
    at[0], at[-1] = 0, len(length) - 1
    return np.unique(at.clip(0, len(length) - 1)).astype(np.int64)


def _follow(
    graph: PoseGraph, log: RobotLog, length: FloatArray, config: DriftConfig, progress: Progress
) -> list[Closure]:
    """Adds node after node, each with its closures and wall direction."""
    points = reflection_points(log, log.odometry, config.reflection)
    submaps: dict[int, Submap] = {}
    closures: list[Closure] = []
    last = len(graph.nodes) - 1
    for node in range(last + 1):
        while len(graph.poses) <= min(node + config.half_span, last):
            graph.extend()
        graph.solve(2)
        local = without_systematic_error(log.odometry, graph.error)
        submaps[node] = _local_map(graph, points, local, length, node, config)
        others = [other for other in submaps if node - other >= config.apart]
        found = close_loops(graph, submaps, node, others, log.t, config.closure, config.matching)
        closures += found
        if any(closure.accepted for closure in found):
            graph.solve(3)
        progress(0.8 * (node + 1) / len(graph.nodes), "closing loops")
    return closures


def _local_map(
    graph: PoseGraph,
    points: ReflectionPoints,
    local: FloatArray,
    length: FloatArray,
    node: int,
    config: DriftConfig,
) -> Submap:
    """The submap of a node; tells the graph the direction of its walls."""
    anchor = int(graph.nodes[node])
    half = (config.half_span + 0.5) * config.spacing
    part = points_of_stretch(points, length, length[anchor] - half, length[anchor] + half)
    if config.use_walls:
        direction = _walls_at(points, local, length, anchor, config.wall_span, config)
        if direction is not None:
            if not graph.walls:
                graph.wall_heading = float(wrap_quarter(direction + graph.poses[node, 2]))
            graph.walls[node] = direction
    return submap(points, local, anchor, part, config.matching)


def _walls_at(
    points: ReflectionPoints,
    local: FloatArray,
    length: FloatArray,
    anchor: int,
    span: float,
    config: DriftConfig,
) -> float | None:
    """Direction of the walls around a scan in its robot's frame, seen within `span` of travel (m)."""
    part = points_of_stretch(points, length, length[anchor] - span, length[anchor] + span)
    return wall_direction(*points_from(points, local, anchor, part), config.walls)


def _align(
    graph: PoseGraph, log: RobotLog, coarse: FloatArray, length: FloatArray, config: DriftConfig
) -> FloatArray:
    """The trajectory (N, 3) through a finer graph in which all visits are aligned."""
    k = config.refinement
    at = np.interp(
        np.arange((len(graph.nodes) - 1) * k + 1) / k,
        np.arange(len(graph.nodes)),
        length[graph.nodes],
    )
    index = np.searchsorted(length, at - 1e-9).clip(0, len(length) - 1)
    index[::k] = graph.nodes
    nodes = np.unique(index).astype(np.int64)
    number = np.searchsorted(nodes, graph.nodes)
    solver = replace(config.graph, wall_sigma=config.aligned_wall_sigma)
    fine = PoseGraph(log.odometry, nodes, config.noise, solver)
    fine.poses = coarse[nodes].copy()
    fine.restart(graph.error, graph.wall_heading)
    fine.links = [
        Link(
            int(number[link.source]),
            int(number[link.target]),
            link.pose,
            link.information * config.kept_closure_weight,
        )
        for link in graph.links
    ]
    points = reflection_points(log, coarse, config.reflection)
    if config.use_walls:
        span = (config.half_span + 0.5) * config.spacing
        seen = {
            node: _walls_at(points, coarse, length, int(scan), span, config)
            for node, scan in enumerate(nodes)
        }
        fine.walls = {node: value for node, value in seen.items() if value is not None}
    align(fine, points, coarse, length, config.alignment)
    return through_nodes(log.odometry, length, nodes, fine.poses)


def _with_sigmas(
    log: RobotLog, length: FloatArray, coarse: PoseGraph, poses: FloatArray
) -> Trajectory:
    """The trajectory with the standard deviations of the coarse graph, whose links are independent."""
    sigma = coarse.pose_sigma()
    at = length[coarse.nodes]
    return Trajectory(
        log.t,
        poses,
        np.interp(length, at, np.hypot(sigma[:, 0], sigma[:, 1]) / math.sqrt(2)),
        np.interp(length, at, sigma[:, 2]),
    )
