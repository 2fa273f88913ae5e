"""Extruded meshes with smooth sides from a field, by marching squares; inner squares are merged."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping.occupancy_grid import GridGeometry

_TAUBIN = (0.5, -0.53)
_SMOOTHING_ROUNDS = 12
_FLAT = 1e-12


@dataclass(frozen=True)
class Mesh:
    """Triangles: `vertices` (V, 3) float32 in world metres, `faces` (F, 3) uint32."""

    vertices: npt.NDArray[np.float32]
    faces: npt.NDArray[np.uint32]

    @property
    def empty(self) -> bool:
        """Whether there is nothing to draw."""
        return len(self.faces) == 0


@dataclass(frozen=True)
class Extrusion:
    """A body standing on the floor: its flat top and its upright sides."""

    cap: Mesh
    sides: Mesh


def extrude(field: FloatArray, level: float, height: float, geometry: GridGeometry) -> Extrusion:
    """The body of the given height (m) over the area where `field` (rows, cols) exceeds `level`.

    The field is sampled at the cells' centres; its outermost ring counts as outside, so that every
    body is closed.
    """
    padded = np.pad(np.asarray(field, float), 1)
    inside = padded > level
    case = (
        inside[:-1, :-1] * 1 + inside[:-1, 1:] * 2 + inside[1:, 1:] * 4 + inside[1:, :-1] * 8
    ).astype(np.int64)
    points = _Points(padded, level, geometry)
    partial = np.argwhere((case > 0) & (case < 15))
    cap_faces, segments = _partial_squares(partial, case, points)
    cap_faces = np.concatenate((cap_faces, _merged_squares(case == 15, points)))
    points.smooth(segments)
    return Extrusion(_cap(points, cap_faces, height), _sides(points, segments, height))


class _Points:
    """Numbers and positions of the lattice's corners and of the level's crossings of its edges.

    Corners come first, row by row, then the crossings of the edges along the rows, then of those
    across. Positions are worked out only for the few that are used.
    """

    def __init__(self, padded: FloatArray, level: float, geometry: GridGeometry) -> None:
        self._padded, self._level, self._geometry = padded, level, geometry
        self._rows, self._cols = padded.shape
        self._first_along = self._rows * self._cols
        self._first_across = self._first_along + self._rows * (self._cols - 1)
        self._smooth_ids = np.zeros(0, np.int64)
        self._smooth_world = np.zeros((0, 2))

    def world_of(self, ids: IntArray) -> FloatArray:
        """World (x, y) of ids (N,) in ascending order."""
        along, across = np.searchsorted(ids, (self._first_along, self._first_across))
        row, col = np.divmod(ids[:along], self._cols)
        corners = np.column_stack((row, col)).astype(float)
        row, col = np.divmod(ids[along:across] - self._first_along, self._cols - 1)
        t = self._crossing(self._padded[row, col], self._padded[row, col + 1])
        on_rows = np.column_stack((row, col + t))
        row, col = np.divmod(ids[across:] - self._first_across, self._cols)
        t = self._crossing(self._padded[row, col], self._padded[row + 1, col])
        on_cols = np.column_stack((row + t, col))
        world = self._geometry.world_of(np.concatenate((corners, on_rows, on_cols)) - 1.0)
        found = np.isin(ids, self._smooth_ids)
        world[found] = self._smooth_world[np.searchsorted(self._smooth_ids, ids[found])]
        return world

    def smooth(self, segments: IntArray) -> None:
        """Takes the waves out of the outlines without shrinking them (Taubin 1995)."""
        if len(segments) == 0:
            return
        used, compact = np.unique(segments, return_inverse=True)
        after = np.empty(len(used), np.int64)
        before = np.empty(len(used), np.int64)
        a, b = compact.reshape(-1, 2).T
        after[a], before[b] = b, a
        line = self.world_of(used)
        for _ in range(_SMOOTHING_ROUNDS):
            for weight in _TAUBIN:
                line = line + weight * ((line[after] + line[before]) / 2 - line)
        self._smooth_ids, self._smooth_world = used, line

    def of_square(self, rows: IntArray, cols: IntArray) -> IntArray:
        """(N, 8) ids: corners 0-3 counter-clockwise from [row, col], then the edges 4-7 after each."""
        corner = rows * self._cols + cols
        along = self._first_along + rows * (self._cols - 1) + cols
        across = self._first_across + corner
        return np.stack(
            (
                corner,
                corner + 1,
                corner + self._cols + 1,
                corner + self._cols,
                along,
                across + 1,
                along + self._cols - 1,
                across,
            ),
            axis=-1,
        )

    def corners(self, rows: IntArray, cols: IntArray) -> IntArray:
        """Ids of lattice corners."""
        return np.asarray(rows * self._cols + cols, np.int64)

    def _crossing(self, a: FloatArray, b: FloatArray) -> FloatArray:
        """Where between a (0) and b (1) the level lies; 0.5 where it does not."""
        step = b - a
        safe = np.where(np.abs(step) < _FLAT, 1.0, step)
        t = (self._level - a) / safe
        return np.where((t > 0) & (t < 1), t, 0.5)


def _polygon(case: int) -> tuple[list[int], list[tuple[int, int]]]:
    """Outline of the inside of a square (ids as in `of_square`) and the pieces of it on the level."""
    inside = [bool(case >> corner & 1) for corner in range(4)]
    outline: list[int] = []
    for corner in range(4):
        if inside[corner]:
            outline.append(corner)
        if inside[corner] != inside[(corner + 1) % 4]:
            outline.append(4 + corner)
    pieces = [
        (a, b)
        for a, b in zip(outline, outline[1:] + outline[:1], strict=True)
        if a >= 4 and b >= 4 and inside[a - 4]
    ]
    return outline, pieces


def _partial_squares(
    squares: IntArray, case: IntArray, points: _Points
) -> tuple[IntArray, IntArray]:
    """Cap triangles (F, 3) and directed boundary segments (S, 2), inside on the left."""
    faces, segments = [np.zeros((0, 3), np.int64)], [np.zeros((0, 2), np.int64)]
    kinds = case[squares[:, 0], squares[:, 1]] if len(squares) else np.zeros(0, np.int64)
    for kind in range(1, 15):
        chosen = squares[kinds == kind]
        if len(chosen) == 0:
            continue
        ids = points.of_square(chosen[:, 0], chosen[:, 1])
        outline, pieces = _polygon(kind)
        faces += [
            ids[:, [outline[0], outline[i], outline[i + 1]]] for i in range(1, len(outline) - 1)
        ]
        segments += [ids[:, [a, b]] for a, b in pieces]
    return np.concatenate(faces), np.concatenate(segments)


def _merged_squares(full: BoolArray, points: _Points) -> IntArray:
    """Two triangles for each of the large rectangles that the full squares are made of."""
    boxes = greedy_rectangles(full)
    if len(boxes) == 0:
        return np.zeros((0, 3), np.int64)
    r0, c0, r1, c1 = boxes.T
    a, b = points.corners(r0, c0), points.corners(r0, c1)
    c, d = points.corners(r1, c1), points.corners(r1, c0)
    return np.concatenate((np.stack((a, b, c), -1), np.stack((a, c, d), -1)))


def greedy_rectangles(mask: BoolArray) -> IntArray:
    """Disjoint rectangles (N, 4) `[row0, col0, row1, col1)` that cover a mask.

    Runs of each row, joined with the same run of the row below.
    """
    edges = np.diff(np.pad(mask.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    starts, stops = np.argwhere(edges == 1), np.argwhere(edges == -1)
    open_runs: dict[tuple[int, int], int] = {}
    boxes: list[tuple[int, int, int, int]] = []
    runs_of_row: dict[int, list[tuple[int, int]]] = {}
    for (row, start), (_, stop) in zip(starts.tolist(), stops.tolist(), strict=True):
        runs_of_row.setdefault(row, []).append((start, stop))
    for row in range(mask.shape[0] + 1):
        runs = set(runs_of_row.get(row, ()))
        ended = [run for run in open_runs if run not in runs]
        boxes.extend((open_runs.pop(run), run[0], row, run[1]) for run in ended)
        for run in runs:
            open_runs.setdefault(run, row)
    return np.array(sorted(boxes), np.int64).reshape(-1, 4)


def _cap(points: _Points, faces: IntArray, height: float) -> Mesh:
    used, compact = np.unique(faces, return_inverse=True)
    vertices = np.column_stack((points.world_of(used), np.full(len(used), height)))
    return Mesh(vertices.astype(np.float32), compact.reshape(-1, 3).astype(np.uint32))


def _sides(points: _Points, segments: IntArray, height: float) -> Mesh:
    used, compact = np.unique(segments, return_inverse=True)
    pairs = compact.reshape(-1, 2)
    flat = points.world_of(used)
    count = len(used)
    vertices = np.concatenate(
        (
            np.column_stack((flat, np.zeros(count))),
            np.column_stack((flat, np.full(count, height))),
        )
    )
    a, b = pairs[:, 0], pairs[:, 1]
    faces = np.concatenate(
        (np.stack((a, b, b + count), -1), np.stack((a, b + count, a + count), -1))
    )
    return Mesh(vertices.astype(np.float32), faces.astype(np.uint32))
