"""The outline of everything solid: straight faces with normals and surfaces, and convex edges.

Boxes overlap (walls run into each other, wardrobes stand in corners). Their union is taken exactly,
on the irregular grid of all their coordinates, so that only what sound can meet remains.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.geometry import AnyArray, BoolArray, FloatArray
from core.simulation.floor_plan import Box
from core.simulation.furniture import SURFACES, Disc
from core.simulation.home import Home

DISC_FACES = 24
"""A round solid is drawn with this many faces."""
STRETCH = 0.7
"""Walls change between plain plaster and fittings about every so many metres."""
FITTINGS_SHARE = 0.3
"""Share of the wall that has fittings (radiator, skirting, frames, switches)."""


@dataclass(frozen=True)
class Outline:
    """What the sonar sees of a home.

    Attributes:
        faces: (F, 4) `x0, y0, x1, y1` in metres; free space lies to the left of the direction.
        normals: (F, 2) unit vectors into free space.
        surfaces: (F, 3) lobe (rad), reflectivity, scatter of the faces' Surface.
        edges: (E, 2) convex edges `(x, y)`, which diffract.
    """

    faces: FloatArray
    normals: FloatArray
    surfaces: FloatArray
    edges: FloatArray


def outline_of(home: Home) -> Outline:
    """The outline of a home. Where its walls have fittings depends on its name and on the place
    only, so that shutting a door changes nothing elsewhere."""
    boxes: list[tuple[Box, str]] = [(wall, "plaster") for wall in home.walls]
    discs: list[tuple[Disc, str]] = []
    for piece in home.furniture:
        for solid in piece.solids:
            if isinstance(solid, Disc):
                discs.append((solid, piece.surface))
            else:
                boxes.append((solid, piece.surface))
    faces, edges = _union(boxes)
    parts = [part for face in faces for part in _in_stretches(face, home.name)]
    parts += [face for disc, surface in discs for face in _around(disc, surface)]
    ends = np.array([part[0] for part in parts], float).reshape(-1, 4)
    along = ends[:, 2:] - ends[:, :2]
    along /= np.maximum(np.hypot(along[:, 0], along[:, 1]), 1e-12)[:, None]
    normals = np.column_stack((-along[:, 1], along[:, 0]))
    surfaces = np.array(
        [(s.lobe, s.reflectivity, s.scatter) for s in (SURFACES[part[1]] for part in parts)], float
    ).reshape(-1, 3)
    return Outline(ends, normals, surfaces, np.array(edges, float).reshape(-1, 2))


Face = tuple[tuple[float, float, float, float], str]


def _union(boxes: Sequence[tuple[Box, str]]) -> tuple[list[Face], list[tuple[float, float]]]:
    """Faces and convex edges of the union of boxes."""
    xs = _coordinates(v for box, _ in boxes for v in (box.x0, box.x1))
    ys = _coordinates(v for box, _ in boxes for v in (box.y0, box.y1))
    names = sorted({surface for _, surface in boxes})
    owner = np.full((len(ys) + 1, len(xs) + 1), -1, np.int64)  # one empty cell around
    for box, surface in reversed(boxes):  # the first box given wins where two overlap
        rows = slice(_place(ys, box.y0) + 1, _place(ys, box.y1) + 1)
        cols = slice(_place(xs, box.x0) + 1, _place(xs, box.x1) + 1)
        owner[rows, cols] = names.index(surface)
    faces = _faces_along_x(owner, xs, ys, names)
    turned = _faces_along_x(owner.T.copy(), ys, xs, names)
    faces += [((y1, x1, y0, x0), surface) for (x0, y0, x1, y1), surface in turned]
    return faces, _convex_edges(owner >= 0, xs, ys)


def _coordinates(values: Iterable[float]) -> FloatArray:
    return np.unique(np.round(np.fromiter(values, float), 6))


def _place(values: FloatArray, value: float) -> int:
    return int(np.searchsorted(values, round(value, 6)))


def _faces_along_x(owner: AnyArray, xs: FloatArray, ys: FloatArray, names: list[str]) -> list[Face]:
    """Faces parallel to x, joined along their line; free space on the left."""
    faces: list[Face] = []
    for row in range(len(ys)):
        below, above = owner[row], owner[row + 1]
        # a top face: solid below, free above; drawn towards +x so that free lies on its left
        top = np.where((below >= 0) & (above < 0), below, -1)
        bottom = np.where((above >= 0) & (below < 0), above, -1)
        for material, first, stop in _runs(top):
            faces.append(((xs[first - 1], ys[row], xs[stop - 1], ys[row]), names[material]))
        for material, first, stop in _runs(bottom):
            faces.append(((xs[stop - 1], ys[row], xs[first - 1], ys[row]), names[material]))
    return faces


def _runs(line: AnyArray) -> list[tuple[int, int, int]]:
    """Maximal runs of equal non-negative values: (value, start, stop)."""
    change = np.flatnonzero(np.diff(line)) + 1
    starts = np.concatenate(([0], change))
    stops = np.concatenate((change, [len(line)]))
    return [
        (int(line[a]), int(a), int(b)) for a, b in zip(starts, stops, strict=True) if line[a] >= 0
    ]


def _convex_edges(solid: BoolArray, xs: FloatArray, ys: FloatArray) -> list[tuple[float, float]]:
    """Grid points with one solid and three free neighbours."""
    around = solid[:-1, :-1].astype(int) + solid[:-1, 1:] + solid[1:, :-1] + solid[1:, 1:]
    return [(float(xs[col]), float(ys[row])) for row, col in np.argwhere(around == 1)]


def _in_stretches(face: Face, key: str) -> list[Face]:
    """A plaster face cut at multiples of STRETCH, some parts with fittings; other faces as they are."""
    (x0, y0, x1, y1), surface = face
    if surface != "plaster":
        return [face]
    vertical = x0 == x1
    start, stop = (y0, y1) if vertical else (x0, x1)
    low, high = min(start, stop), max(start, stop)
    cuts = [n * STRETCH for n in range(math.ceil(low / STRETCH), math.floor(high / STRETCH) + 1)]
    ends = [low, *(cut for cut in cuts if low < cut < high), high]
    parts: list[Face] = []
    for a, b in pairwise(ends):
        place = f"{key}/{x0 if vertical else y0:.2f}/{vertical}/{math.floor((a + b) / 2 / STRETCH)}"
        chosen = "fittings" if _share_of(place) < FITTINGS_SHARE else "plaster"
        p, q = (a, b) if start < stop else (b, a)
        parts.append(((x0, p, x1, q) if vertical else (p, y0, q, y1), chosen))
    return parts


def _share_of(text: str) -> float:
    """A number in [0, 1) that depends on nothing but the text."""
    return zlib.crc32(text.encode()) / 2**32


def _around(disc: Disc, surface: str) -> list[Face]:
    """The faces of a round solid, clockwise, so that free space lies on their left."""
    angles = -2 * np.pi * np.arange(DISC_FACES + 1) / DISC_FACES
    x, y = disc.x + disc.radius * np.cos(angles), disc.y + disc.radius * np.sin(angles)
    return [((x[i], y[i], x[i + 1], y[i + 1]), surface) for i in range(DISC_FACES)]
