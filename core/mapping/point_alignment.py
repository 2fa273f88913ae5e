"""The last centimetres: aligning all visits of a surface with each other.

The reflecting points of each short stretch are gathered into small surface patches (a mean position and
a mean view direction, which is the surface's normal, since a sonar hears what faces it). Patches of
different visits that are near and face the same way should lie in one plane; the pose graph moves its
nodes to make them so. Repeated with a shrinking gate, like ICP with point-to-plane distances between all
scans at once (Lu and Milios 1997).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from core.geometry import FloatArray, IntArray, compose, inverse
from core.mapping.graph_terms import PointLinks
from core.mapping.point_frames import transform_each, unit
from core.mapping.pose_graph import PoseGraph
from core.mapping.reflection_points import ReflectionPoints


@dataclass(frozen=True)
class AlignmentConfig:
    """Parameters.

    Attributes:
        gates: how far apart (m) two patches may be, one per round.
        patch: side of a patch (m).
        same_facing: least cosine between the normals of a pair.
        apart: travel (m) between the stretches of a pair: nearer ones shared the votes.
        partners: at most this many pairs per patch, the nearest ones.
        sigma: standard deviation of a pair (m). Pairs are many and not independent: far wider than
            the error of one.
        steps: Gauss-Newton steps a round.
    """

    gates: tuple[float, ...] = (0.35, 0.25, 0.2, 0.15, 0.15)
    patch: float = 0.1
    same_facing: float = 0.8
    apart: float = 3.0
    partners: int = 10
    sigma: float = 0.2
    steps: int = 2


@dataclass(frozen=True)
class Patches:
    """Surface patches: node, position and normal (times the root of the count) in the node's frame."""

    node: IntArray
    position: FloatArray
    normal: FloatArray
    count: FloatArray


def align(
    graph: PoseGraph,
    points: ReflectionPoints,
    poses: FloatArray,
    length: FloatArray,
    config: AlignmentConfig | None = None,
) -> None:
    """Moves the nodes of the graph until the visits agree.

    Args:
        graph: all nodes reached; changed in place.
        points: reflecting points of the log.
        poses: (N, 3) trajectory through the graph's nodes.
        length: (N,) travel at the scans (m).
        config: parameters.
    """
    config = config or AlignmentConfig()
    patches = _patches(graph, points, poses, length, config)
    if len(patches.node) == 0:
        return
    at = length[graph.nodes]
    for gate in config.gates:
        graph.point_links = _pairs(graph.poses, patches, at, gate, config)
        graph.solve(config.steps)


def _patches(
    graph: PoseGraph,
    points: ReflectionPoints,
    poses: FloatArray,
    length: FloatArray,
    config: AlignmentConfig,
) -> Patches:
    """The strong points, gathered by node, cell and quadrant of view."""
    scan = points.scan[points.strong]
    middle = 0.5 * (length[graph.nodes[:-1]] + length[graph.nodes[1:]])
    node = np.searchsorted(middle, length[scan]).astype(np.int64)
    local = compose(inverse(poses[graph.nodes])[node], poses[scan])
    seen = transform_each(local, points.point[points.strong])
    view = unit(seen - transform_each(local, points.sonar[points.strong]))
    quadrant = np.floor(np.arctan2(view[:, 1], view[:, 0]) / (np.pi / 2)).astype(np.int64)
    cell = np.floor(seen / config.patch).astype(np.int64)
    key = np.column_stack((node, cell, quadrant))
    _, first, group, count = np.unique(
        key, axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    group = group.ravel()
    position = np.stack([np.bincount(group, seen[:, k]) / count for k in (0, 1)], axis=1)
    normal = unit(np.stack([np.bincount(group, view[:, k]) for k in (0, 1)], axis=1))
    return Patches(node[first], position, normal, count.astype(float))


def _pairs(
    nodes: FloatArray, patches: Patches, at: FloatArray, gate: float, config: AlignmentConfig
) -> PointLinks:
    """Patches of different visits that seem to be one surface, weighted by how near they are."""
    world = transform_each(nodes[patches.node], patches.position)
    turned = nodes[patches.node, 2]
    c, s = np.cos(turned), np.sin(turned)
    facing = np.stack(
        (
            c * patches.normal[:, 0] - s * patches.normal[:, 1],
            s * patches.normal[:, 0] + c * patches.normal[:, 1],
        ),
        axis=1,
    )
    tree = cKDTree(world)
    near = tree.query_pairs(gate, output_type="ndarray")
    a, b = near[:, 0], near[:, 1]
    travel = at[patches.node]
    keep = (np.abs(travel[a] - travel[b]) >= config.apart) & (
        (facing[a] * facing[b]).sum(axis=1) >= config.same_facing
    )
    a, b = a[keep], b[keep]
    distance = np.hypot(*(world[a] - world[b]).T)
    order = np.argsort(distance, kind="stable")
    a, b, distance = a[order], b[order], distance[order]
    chosen = (_rank_in_group(a) < config.partners) & (_rank_in_group(b) < config.partners)
    a, b, distance = a[chosen], b[chosen], distance[chosen]
    normal = unit(facing[a] + facing[b])
    trust = (1 - (distance / gate) ** 2) ** 2
    weight = trust * np.sqrt(np.minimum(patches.count[a], patches.count[b])) / config.sigma**2
    return PointLinks(
        patches.node[a],
        patches.node[b],
        patches.position[a],
        patches.position[b],
        normal,
        weight,
    )


def _rank_in_group(group: IntArray) -> IntArray:
    """(M,) how many equal values come before each value."""
    order = np.argsort(group, kind="stable")
    ordered = group[order]
    start = (
        np.concatenate(([True], ordered[1:] != ordered[:-1])) if len(group) else np.zeros(0, bool)
    )
    begin = np.maximum.accumulate(np.where(start, np.arange(len(group)), 0))
    rank = np.empty(len(group), np.int64)
    rank[order] = np.arange(len(group)) - begin
    return rank
