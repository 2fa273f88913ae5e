"""How good a map is, compared with the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.evaluation.ground_truth import GroundTruth, sampled
from core.geometry import BoolArray, FloatArray
from core.mapping.occupancy_grid import OccupancyGrid

FAR = 1000.0
"""A distance in cells for "nowhere near"."""


@dataclass(frozen=True)
class MapMetricsConfig:
    """What counts as passable, leaking and the same place; all metres.

    Attributes:
        margin: occupied cells this far outside the home still lie on its walls.
        leak: claimed free floor counts as a leak when it is farther than this from real floor.
        robot_radius: a door is passable when a robot of this radius gets through.
        door_before, door_beside: the part of the map looked at for the passage.
        shut_around: how much around a door is taken out when all doors are shut.
        leak_width: half width of a hole in a wall that joins two rooms.
        smallest_room: square metres of a room's map that a leak can be told from.
    """

    margin: float = 1.5
    leak: float = 0.15
    robot_radius: float = 0.2
    door_before: float = 0.35
    door_beside: float = 0.1
    shut_around: float = 0.3
    leak_width: float = 0.1
    smallest_room: float = 0.5


@dataclass(frozen=True)
class MapMetrics:
    """The metrics of one map.

    Attributes:
        precision_1, precision_2: share of the occupied cells within 1 / 2 cells (Chebyshev) of
            something really occupied.
        surface_2: share of them within 2 cells of a surface that can be seen.
        recall_1, recall_2: share of the surface cells of the explored part with an occupied cell
            that near.
        free_iou: intersection over union of free space in the explored part; free space claimed
            where there is none counts against it wherever it is.
        leak_m2: claimed free area away from any real free space.
        doors, doors_blocked: doors of the explored part, and those the robot cannot pass in the map.
        rooms_seen, leaks: rooms of the map, and joins between them when every door is shut.
        occupied_cells, free_m2: size of the map.
    """

    precision_1: float
    precision_2: float
    surface_2: float
    recall_1: float
    recall_2: float
    free_iou: float
    leak_m2: float
    doors: int
    doors_blocked: int
    rooms_seen: int
    leaks: int
    occupied_cells: int
    free_m2: float


def map_metrics(
    grid: OccupancyGrid, truth: GroundTruth, config: MapMetricsConfig | None = None
) -> MapMetrics:
    """Compares a map with the truth; both in the same frame."""
    config = config or MapMetricsConfig()
    truth = truth.padded(config.margin)
    centres = truth.centres()
    occupied = sampled(grid.occupied, grid.geometry, centres, 0) > 0
    free = sampled(grid.free, grid.geometry, centres, 0) > 0
    surface = truth.occupied & _grown(truth.free)
    claims = grid.geometry.world_of(np.argwhere(grid.occupied))
    off_any = _distance_at(truth.occupied, truth, claims)
    off_surface = _distance_at(surface, truth, claims)
    seen = centres[surface & _grown(truth.explored)]
    scale = grid.geometry.resolution / truth.geometry.resolution
    missed = sampled(_chessboard(grid.occupied) * scale, grid.geometry, seen, FAR)
    real = truth.free & truth.explored
    union = (free & (truth.explored | ~truth.free)) | real
    doors, blocked, around = _doors(free, occupied, truth, config)
    rooms, leaks = _leaks(free, occupied, around, truth, config)
    cell = truth.geometry.resolution
    return MapMetrics(
        precision_1=_share(off_any <= 1),
        precision_2=_share(off_any <= 2),
        surface_2=_share(off_surface <= 2),
        recall_1=_share(missed <= 1),
        recall_2=_share(missed <= 2),
        free_iou=float((free & real).sum() / max(1, union.sum())),
        leak_m2=float((free & (_metres_from(truth.free, cell) > config.leak)).sum() * cell**2),
        doors=doors,
        doors_blocked=blocked,
        rooms_seen=rooms,
        leaks=leaks,
        occupied_cells=int(grid.occupied.sum()),
        free_m2=float(free.sum() * cell**2),
    )


def _distance_at(mask: BoolArray, truth: GroundTruth, points: FloatArray) -> FloatArray:
    """Chebyshev distance in cells from world points (N, 2) to a mask on the truth's grid."""
    return sampled(_chessboard(mask), truth.geometry, points, FAR)


def _chessboard(mask: BoolArray) -> FloatArray:
    if not mask.any():
        return np.full(mask.shape, FAR)
    return np.asarray(ndimage.distance_transform_cdt(~mask, "chessboard"), float)


def _metres_from(mask: BoolArray, resolution: float) -> FloatArray:
    """Euclidean distance (m) to a mask."""
    if not mask.any():
        return np.full(mask.shape, FAR)
    return np.asarray(ndimage.distance_transform_edt(~mask) * resolution)


def _grown(mask: BoolArray) -> BoolArray:
    return np.asarray(ndimage.binary_dilation(mask, np.ones((3, 3))))


def _share(mask: BoolArray) -> float:
    return float(mask.mean()) if mask.size else 0.0


def _doors(
    free: BoolArray, occupied: BoolArray, truth: GroundTruth, config: MapMetricsConfig
) -> tuple[int, int, BoolArray]:
    """How many doors were seen, how many of them are blocked, and the floor around the seen ones."""
    clear = _metres_from(occupied, truth.geometry.resolution)
    passable = free & (clear > config.robot_radius)
    around = np.zeros(free.shape, np.bool_)
    seen = blocked = 0
    for x0, y0, x1, y1 in truth.doors:
        along_x = x1 - x0 < y1 - y0
        before, beside = config.door_before, config.door_beside
        dx, dy = (before, beside) if along_x else (beside, before)
        part = _window(truth, x0 - dx, y0 - dy, x1 + dx, y1 + dy)
        floor = truth.free[part]
        if (truth.explored[part] & floor).sum() < 0.5 * floor.sum():
            continue
        seen += 1
        labels, _ = ndimage.label(passable[part])
        ends = (labels[:, 0], labels[:, -1]) if along_x else (labels[0], labels[-1])
        joined = (set(ends[0].tolist()) & set(ends[1].tolist())) - {0}
        blocked += not joined
        wide = config.shut_around
        around[_window(truth, x0 - wide, y0 - wide, x1 + wide, y1 + wide)] = True
    return seen, blocked, around


def _window(truth: GroundTruth, x0: float, y0: float, x1: float, y1: float) -> tuple[slice, slice]:
    """The cells of the truth that a box (m) covers."""
    (low_row, low_col), (high_row, high_col) = truth.geometry.cell_of([(x0, y0), (x1, y1)])
    return (
        slice(max(int(low_row), 0), int(high_row) + 1),
        slice(max(int(low_col), 0), int(high_col) + 1),
    )


def _leaks(
    free: BoolArray,
    occupied: BoolArray,
    around_doors: BoolArray,
    truth: GroundTruth,
    config: MapMetricsConfig,
) -> tuple[int, int]:
    """Rooms seen in the map with all doors shut, and how many of them still hang together."""
    cell = truth.geometry.resolution
    open_floor = free & ~around_doors & (_metres_from(occupied, cell) > config.leak_width)
    labels, _ = ndimage.label(open_floor)
    parts = []
    for room in range(1, int(truth.rooms.max(initial=0)) + 1):
        inside = labels[(truth.rooms == room) & truth.explored & (labels > 0)]
        if len(inside) * cell**2 > config.smallest_room:
            parts.append(int(np.bincount(inside).argmax()))
    return len(parts), len(parts) - len(set(parts))
