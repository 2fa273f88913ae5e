"""Shapes of the topological map: spheres for nodes, lines through the doorways for edges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.viewer.contour_mesh import Mesh
from core.geometry import FloatArray
from core.topology import TopologicalMap

_GOLDEN = (1 + 5**0.5) / 2


@dataclass(frozen=True)
class GraphConfig:
    """Heights and sizes in metres."""

    height: float = 1.55
    """Of the nodes above the floor: clear of the walls."""
    radius: float = 0.17
    smallest_share: float = 0.75
    """Radius of the smallest node against `radius`; size tells the floor's area."""
    largest_share: float = 1.5
    typical_area: float = 15.0
    """Square metres of a node of share 1."""


def node_radii(topology: TopologicalMap, config: GraphConfig) -> FloatArray:
    """(N,) radius of each node's sphere, growing with the root of its area."""
    share = np.sqrt(np.array([node.area_m2 for node in topology.nodes]) / config.typical_area)
    return config.radius * np.clip(share, config.smallest_share, config.largest_share)


def node_centres(topology: TopologicalMap, config: GraphConfig) -> FloatArray:
    """(N, 3) where the spheres float."""
    flat = np.array([node.position for node in topology.nodes], float).reshape(-1, 2)
    return np.column_stack((flat, np.full(len(flat), config.height)))


def edge_segments(topology: TopologicalMap, config: GraphConfig) -> FloatArray:
    """(2 E, 2, 3) from node to doorway to node."""
    position = {node.id: node.position for node in topology.nodes}
    segments = []
    for edge in topology.edges:
        if edge.source in position and edge.target in position:
            corners = (position[edge.source], edge.doorway, position[edge.target])
            a, door, b = ((x, y, config.height) for x, y in corners)
            segments += [(a, door), (door, b)]
    return np.array(segments, float).reshape(-1, 2, 3)


def stem_segments(centres: FloatArray) -> FloatArray:
    """(N, 2, 3) from each node straight down to the floor."""
    feet = centres.copy()
    feet[:, 2] = 0.02
    return np.stack((feet, centres), axis=1)


def doorways(topology: TopologicalMap, config: GraphConfig) -> FloatArray:
    """(E, 3) the bends of the edges."""
    flat = np.array([edge.doorway for edge in topology.edges], float).reshape(-1, 2)
    return np.column_stack((flat, np.full(len(flat), config.height)))


def icosphere(subdivisions: int = 2) -> Mesh:
    """A unit sphere: an icosahedron whose faces are split into four `subdivisions` times."""
    vertices: list[tuple[float, float, float]] = []
    for a in (-1.0, 1.0):
        for b in (-_GOLDEN, _GOLDEN):
            vertices += [(0.0, a, b), (a, b, 0.0), (b, 0.0, a)]
    points = np.array(vertices)
    gap = np.linalg.norm(points[:, None] - points[None], axis=-1)
    near = np.isclose(gap, 2.0)
    faces = [
        (i, j, k)
        for i in range(12)
        for j in range(i + 1, 12)
        for k in range(j + 1, 12)
        if near[i, j] and near[j, k] and near[i, k]
    ]
    mesh_faces = np.array([_outward(points, face) for face in faces])
    points = points / np.linalg.norm(points, axis=1, keepdims=True)
    for _ in range(subdivisions):
        points, mesh_faces = _split(points, mesh_faces)
    return Mesh(points.astype(np.float32), mesh_faces.astype(np.uint32))


def circle(centre: Sequence[float], radius: float, pieces: int = 40) -> FloatArray:
    """(pieces, 2, 3) segments of a level circle."""
    turn = np.linspace(0, 2 * np.pi, pieces + 1)
    line = np.column_stack((np.cos(turn), np.sin(turn), np.zeros(pieces + 1))) * radius
    line += np.asarray(centre, float)
    return np.stack((line[:-1], line[1:]), axis=1)


def unit_square() -> Mesh:
    """A square of edge 1 that lies on z = 0, centred."""
    corners = np.array([(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)], np.float32)
    return Mesh(corners, np.array([(0, 1, 2), (0, 2, 3)], np.uint32))


def unit_box() -> Mesh:
    """A box of edge 1 that stands on z = 0, centred in x and y."""
    x = np.array([-0.5, 0.5])
    vertices = np.array([(a, b, c) for c in (0.0, 1.0) for b in x for a in x])
    quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    corners: list[FloatArray] = []
    faces: list[tuple[int, int, int]] = []
    for quad in quads:
        base = len(corners)
        corners += [vertices[i] for i in quad]
        faces += [(base, base + 1, base + 2), (base, base + 2, base + 3)]
    return Mesh(np.array(corners, np.float32), np.array(faces, np.uint32))


def _outward(points: FloatArray, face: Sequence[int]) -> tuple[int, int, int]:
    i, j, k = face
    normal = np.cross(points[j] - points[i], points[k] - points[i])
    return (i, j, k) if normal @ points[i] > 0 else (i, k, j)


def _split(points: FloatArray, faces: FloatArray) -> tuple[FloatArray, FloatArray]:
    a, b, c = faces.T
    edges = np.sort(np.concatenate((faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]])), axis=1)
    unique, index = np.unique(edges, axis=0, return_inverse=True)
    middle = points[unique].mean(axis=1)
    middle /= np.linalg.norm(middle, axis=1, keepdims=True)
    ab, bc, ca = index.reshape(3, -1) + len(points)
    split = np.concatenate(
        (
            np.stack((a, ab, ca), -1),
            np.stack((b, bc, ab), -1),
            np.stack((c, ca, bc), -1),
            np.stack((ab, bc, ca), -1),
        )
    )
    return np.concatenate((points, middle)), split
