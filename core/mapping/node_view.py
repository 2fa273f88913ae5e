"""What a node of the pose graph sees: the local map around it and the direction of its walls."""

from __future__ import annotations

from core.geometry import FloatArray
from core.mapping.drift_config import DriftConfig
from core.mapping.point_frames import points_from, points_of_stretch
from core.mapping.pose_graph import PoseGraph
from core.mapping.reflection_points import ReflectionPoints
from core.mapping.submap import Submap, submap
from core.mapping.wall_direction import wall_direction, wrap_quarter


def local_map(
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
        direction = walls_at(points, local, length, anchor, config.wall_span, config)
        if direction is not None:
            if not graph.walls:
                graph.wall_heading = float(wrap_quarter(direction + graph.poses[node, 2]))
            graph.walls[node] = direction
    return submap(points, local, anchor, part, config.matching)


def walls_at(
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
