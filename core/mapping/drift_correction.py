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
from dataclasses import dataclass, replace

import numpy as np

from core.geometry import FloatArray, IntArray
from core.mapping.drift_config import DriftConfig
from core.mapping.drift_edits import DriftEdits
from core.mapping.graph_terms import Link
from core.mapping.loop_closure import Closure, close_loops
from core.mapping.node_view import local_map, walls_at
from core.mapping.odometry_calibration import OdometryCalibration
from core.mapping.odometry_model import through_nodes, without_systematic_error
from core.mapping.point_alignment import align
from core.mapping.pose_graph import PoseGraph
from core.mapping.reflection_points import path_length, reflection_points
from core.mapping.said_links import SaidLinks
from core.mapping.submap import Submap
from core.progress import Progress, no_progress
from core.sensing.robot_log import RobotLog
from core.sensing.trajectory import Trajectory


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
    log: RobotLog,
    config: DriftConfig | None = None,
    progress: Progress = no_progress,
    edits: DriftEdits | None = None,
) -> DriftResult:
    """The corrected trajectory of a drive whose odometry does not break off.

    Args:
        log: the drive; at least two scans. See `odometry_breaks` for jumps and carried robots.
        config: parameters.
        progress: told after each node.
        edits: what a person says about it.

    Raises:
        InputError: the edits speak of another drive, or of its start.
    """
    config, edits = config or DriftConfig(), edits or DriftEdits()
    length = path_length(log.odometry, config.reflection.metres_per_radian)
    nodes = _nodes(length, config.spacing)
    graph = PoseGraph(log.odometry, nodes, config.noise, config.graph)
    closures = _follow(graph, log, length, config, progress, edits)
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
    graph: PoseGraph,
    log: RobotLog,
    length: FloatArray,
    config: DriftConfig,
    progress: Progress,
    edits: DriftEdits,
) -> list[Closure]:
    """Adds node after node, each with its closures and wall direction."""
    said = SaidLinks(edits, log.t, graph.nodes, log.odometry)
    points = reflection_points(log, log.odometry, config.reflection)
    submaps: dict[int, Submap] = {}
    closures: list[Closure] = []
    last = len(graph.nodes) - 1
    for node in range(last + 1):
        while len(graph.poses) <= min(node + config.half_span, last):
            graph.extend()
        graph.solve(2)
        local = without_systematic_error(log.odometry, graph.error)
        submaps[node] = local_map(graph, points, local, length, node, config)
        links = len(graph.links)
        closures += said.link(graph, submaps, node, config.matching)
        told = said.others(node)
        others = [o for o in submaps if node - o >= config.apart and o not in told]
        closures += close_loops(
            graph, submaps, node, others, log.t, config.closure, config.matching, edits.rejected
        )
        if len(graph.links) > links:
            graph.solve(3)
        progress(0.8 * (node + 1) / len(graph.nodes), "closing loops")
    return closures


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
            link.information * (1.0 if link.by_person else config.kept_closure_weight),
            link.by_person,
        )
        for link in graph.links
    ]
    points = reflection_points(log, coarse, config.reflection)
    if config.use_walls:
        span = (config.half_span + 0.5) * config.spacing
        seen = {
            node: walls_at(points, coarse, length, int(scan), span, config)
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
