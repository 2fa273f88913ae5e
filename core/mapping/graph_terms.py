"""What the measurements add to the normal equations of the pose graph.

Each function linearises one kind of measurement at the current poses. Entries of the sparse system are
returned, entries of the right side are added in place.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.geometry import AnyArray, FloatArray, IntArray, between, wrap_angle
from core.mapping.wall_direction import wrap_quarter

Entries = tuple[AnyArray, AnyArray, AnyArray]
"""Rows, columns and values of a sparse matrix."""
WALL_HEADING_PRIOR = math.radians(60)
"""How little is known of the walls' direction before the first one is seen; keeps the system regular."""


@dataclass(frozen=True)
class Link:
    """A measured relative pose.

    Attributes:
        source, target: node numbers.
        pose: (3,) of the target in the frame of the source.
        information: (3, 3) inverse covariance.
        by_person: a person said so: it counts in full however far off it is.
    """

    source: int
    target: int
    pose: FloatArray
    information: FloatArray
    by_person: bool = False


@dataclass(frozen=True)
class PointLinks:
    """Pairs of surface points, each seen from one node, that should lie in one plane.

    Attributes:
        source, target: (P,) node numbers.
        at_source, at_target: (P, 2) the points in the frames of their nodes.
        normal: (P, 2) of the surface, in the map's frame.
        weight: (P,) inverse variance of their distance along the normal.
    """

    source: IntArray
    target: IntArray
    at_source: FloatArray
    at_target: FloatArray
    normal: FloatArray
    weight: FloatArray


def wall_entries(
    poses: FloatArray,
    walls: dict[int, float],
    wall_heading: float,
    sigma: float,
    kernel: float,
    right: FloatArray,
) -> list[Entries]:
    """Entries of the system by the wall directions; adds to the right side in place."""
    last = np.array([len(right) - 1])
    blocks = [(last, last, np.array([1 / WALL_HEADING_PRIOR**2]))]
    node = np.array([n for n in walls if n < len(poses)], np.int64)
    if len(node) == 0:
        return blocks
    local = np.array([walls[n] for n in node])
    residual = wrap_quarter(poses[node, 2] + local - wall_heading)
    trust = 1 / (1 + (residual / sigma) ** 2 / kernel) ** 2
    info = trust / sigma**2
    heading, shared = 3 * node + 2, np.full(len(node), last[0])
    right[heading] -= info * residual
    right[last] += (info * residual).sum()
    blocks += [
        (heading, heading, info),
        (heading, shared, -info),
        (shared, heading, -info),
        (last, last, np.array([info.sum()])),
    ]
    return blocks


def point_entries(poses: FloatArray, links: PointLinks, right: FloatArray) -> list[Entries]:
    """Entries of the system by the point pairs; adds to the right side in place."""
    sides = []
    for node, local in ((links.source, links.at_source), (links.target, links.at_target)):
        c, s = np.cos(poses[node, 2]), np.sin(poses[node, 2])
        arm = np.stack(
            (c * local[:, 0] - s * local[:, 1], s * local[:, 0] + c * local[:, 1]), axis=1
        )
        by_turn = links.normal[:, 1] * arm[:, 0] - links.normal[:, 0] * arm[:, 1]
        by_pose = np.concatenate((links.normal, by_turn[:, None]), axis=1)
        sides.append((node, poses[node, :2] + arm, by_pose))
    (a, at_a, by_a), (b, at_b, by_b) = sides
    residual = ((at_a - at_b) * links.normal).sum(axis=1)
    by_b = -by_b
    k = np.arange(3)
    blocks = []
    for i, by_i in ((a, by_a), (b, by_b)):
        np.add.at(right, 3 * i[:, None] + k, -by_i * (links.weight * residual)[:, None])
        for j, by_j in ((a, by_a), (b, by_b)):
            key, group = np.unique(i * len(poses) + j, return_inverse=True)
            product = links.weight[:, None, None] * by_i[:, :, None] * by_j[:, None, :]
            total = np.stack(
                [np.bincount(group, product[:, m, n]) for m in range(3) for n in range(3)],
                axis=1,
            ).reshape(-1, 3, 3)
            i_of, j_of = np.divmod(key, len(poses))
            row = np.broadcast_to((3 * i_of[:, None] + k)[:, :, None], total.shape)
            col = np.broadcast_to((3 * j_of[:, None] + k)[:, None, :], total.shape)
            blocks.append((row.ravel(), col.ravel(), total.ravel()))
    return blocks


def residuals(
    poses: FloatArray, source: IntArray, target: IntArray, measured: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """(E, 3) residuals `between(source, target) - measured` and derivatives (E, 3, 3) by both."""
    a, b = poses[source], poses[target]
    residual = between(a, b) - measured
    residual[:, 2] = wrap_angle(residual[:, 2])
    c, s = np.cos(a[:, 2]), np.sin(a[:, 2])
    dx, dy = b[:, 0] - a[:, 0], b[:, 1] - a[:, 1]
    zero, one = np.zeros_like(c), np.ones_like(c)
    at_source = np.stack(
        (-c, -s, -s * dx + c * dy, s, -c, -c * dx - s * dy, zero, zero, -one), axis=1
    ).reshape(-1, 3, 3)
    at_target = np.stack((c, s, zero, -s, c, zero, zero, zero, one), axis=1).reshape(-1, 3, 3)
    return residual, at_source, at_target
