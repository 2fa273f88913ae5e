"""Submaps: the reflecting points of a few metres of travel, seen from the pose in their middle.

Two things are different with sonar:

- a point carries the direction it was seen in, and two points agree by the cosine between their
  directions: the two faces of a wall, seen from two rooms, repel each other instead of merging (which
  would shrink the map);
- the density is not capped early: many arcs that cross at one place are worth more than their number.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np
import numpy.typing as npt
from scipy import ndimage

from core.geometry import FloatArray, compose, inverse
from core.mapping.matching_config import MatchingConfig
from core.mapping.point_frames import transform_each, unit
from core.mapping.reflection_points import ReflectionPoints

Float32Array = npt.NDArray[np.float32]


@dataclass(frozen=True)
class Submap:
    """A local map seen from the pose of one scan.

    Attributes:
        anchor: index of the scan whose pose is the frame.
        points: (M, 2) thinned strong points in metres.
        views: (M, 2) unit vectors from the sonar to the point, times the point's weight.
        weight: sum of the weights.
        density: (rows, cols, 3) sum of views x, y and penalty of free space; index 0 along x.
        corner: (2,) position of density[0, 0]'s outer corner.
    """

    anchor: int
    points: FloatArray
    views: FloatArray
    weight: float
    density: Float32Array
    corner: FloatArray


def submap(
    points: ReflectionPoints,
    poses: FloatArray,
    anchor: int,
    part: slice,
    config: MatchingConfig | None = None,
) -> Submap:
    """The local map of the points `part` seen from the pose of the scan `anchor`.

    Args:
        points: the reflecting points of the log.
        poses: (N, 3) poses that are right over the stretch.
        anchor: index of the scan.
        part: which of the points.
        config: parameters.
    """
    config = config or MatchingConfig()
    local = compose(inverse(poses[anchor]), poses[points.scan[part]])
    seen = transform_each(local, points.point[part])
    origin = transform_each(local, points.sonar[part])
    strong = points.strong[part]
    view = unit(seen - origin)
    thinned, views, weight = _thin(seen[strong], view[strong], config)
    density, corner = _density(seen, origin, view, strong, config)
    return Submap(anchor, thinned, views, weight, density, corner)


def _thin(
    points: FloatArray, view: FloatArray, config: MatchingConfig
) -> tuple[FloatArray, FloatArray, float]:
    """Mean point and summed view of each cell, the number of points capped; the sum of weights."""
    if len(points) == 0:
        return np.zeros((0, 2)), np.zeros((0, 2)), 0.0
    cells = np.floor(points / config.point_cell).astype(np.int64)
    _, group, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
    group = group.ravel()
    scale = np.minimum(count, config.point_cap) / count
    mean = np.stack([np.bincount(group, points[:, k]) / count for k in (0, 1)], axis=1)
    views = np.stack([np.bincount(group, view[:, k]) * scale for k in (0, 1)], axis=1)
    return mean, views, float(np.minimum(count, config.point_cap).sum())


def _density(
    seen: FloatArray, origin: FloatArray, view: FloatArray, strong: npt.NDArray[np.bool_],
    config: MatchingConfig,
) -> tuple[Float32Array, FloatArray]:  # fmt: skip
    """The density of the views and the penalty of free space on one grid; its corner."""
    everything = np.concatenate((seen, origin, np.zeros((1, 2))))
    corner = np.floor((everything.min(axis=0) - config.margin) / config.cell) * config.cell
    shape = np.ceil((everything.max(axis=0) + config.margin - corner) / config.cell).astype(int)
    count = np.zeros((*shape, 3), np.float32)
    cells = ((seen[strong] - corner) / config.cell).astype(np.int64)
    _accumulate(count, cells, view[strong])
    spread = config.smoothing / config.cell
    for k in range(3):
        count[..., k] = ndimage.gaussian_filter(count[..., k], spread)
    crossed = np.zeros(tuple(shape), np.int32)
    _cross(crossed, corner, config.cell, origin, seen, config.ray_end)
    peak_of_one = 1.0 / (2 * math.pi * spread**2)
    free = (crossed >= config.free_rays) & (count[..., 2] < peak_of_one)
    size = np.hypot(count[..., 0], count[..., 1])
    typical = float((size**2).sum() / size.sum()) if size.any() else 1.0
    full = config.full_density * typical
    shrink = 1.0 / np.maximum(size, full)
    density = np.empty((*shape, 3), np.float32)
    density[..., :2] = (1 - config.same_side) * count[..., :2] * shrink[..., None]
    density[..., 2] = config.same_side * count[..., 2] * shrink - config.free_penalty * free
    return density, corner


@numba.njit(cache=True)
def _accumulate(count, cells, view):  # type: ignore[no-untyped-def]
    for i in range(len(cells)):
        u, v = cells[i, 0], cells[i, 1]
        count[u, v, 0] += view[i, 0]
        count[u, v, 1] += view[i, 1]
        count[u, v, 2] += 1


@numba.njit(cache=True)
def _cross(crossed, corner, cell, origin, seen, ray_end):  # type: ignore[no-untyped-def]
    """Counts the rays that cross each cell."""
    for i in range(len(origin)):
        dx, dy = seen[i, 0] - origin[i, 0], seen[i, 1] - origin[i, 1]
        length = math.hypot(dx, dy)
        steps = int((length - ray_end) / cell)
        for j in range(steps + 1):
            along = j * cell / max(length, 1e-9)
            u = int((origin[i, 0] + along * dx - corner[0]) / cell)
            v = int((origin[i, 1] + along * dy - corner[1]) / cell)
            crossed[u, v] += 1
