"""Correlative matching of one local sonar map with another.

A submap is the reflecting points of a few metres of travel, seen from the pose in its middle. Two
submaps are compared by the sum over the points of one of the density of the other, for all poses on a
lattice (Olson 2009: correlative scan matching). Two things are different with sonar:

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
from core.mapping.reflection_points import ReflectionPoints

Float32Array = npt.NDArray[np.float32]


@dataclass(frozen=True)
class MatchingConfig:
    """Parameters of the correlative matching.

    Attributes:
        cell: lattice of positions and cell of the density (m).
        turn_step: lattice of headings (rad).
        smoothing: standard deviation of the density's smoothing (m).
        full_density: the density that counts as 1, in units of the submap's typical density (its mean
            over its own points).
        free_penalty: what a point in the other submap's free space costs.
        free_rays: rays that must cross a cell to call it free.
        ray_end: a ray ends this far in front of its point (m).
        point_cell, point_cap: points are thinned to one a cell (m) with a weight of at most the cap.
        same_side: share of the agreement that does not depend on the direction of view: 0 makes the
            two faces of a wall repel each other, 0.5 makes them indifferent.
        margin: density is kept this far around the points (m).
        sharpness: a pose is exp(sharpness (score - best)) times as likely as the best one.
        likely: less likely ones do not count for the covariance.
        position_floor, heading_floor: standard deviation (m, rad) of even the best match.
        peak_exclusion: lattice steps around the best pose that do not count as a second best one.
    """

    cell: float = 0.1
    turn_step: float = math.radians(2.0)
    smoothing: float = 0.09
    full_density: float = 2.0
    free_penalty: float = 0.5
    free_rays: int = 2
    ray_end: float = 0.2
    point_cell: float = 0.05
    point_cap: int = 4
    same_side: float = 0.5
    margin: float = 1.5
    sharpness: float = 40.0
    likely: float = 0.01
    position_floor: float = 0.06
    heading_floor: float = math.radians(1.3)
    peak_exclusion: int = 3


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


@dataclass(frozen=True)
class Match:
    """The best pose of one submap in the frame of another.

    Attributes:
        pose: (3,) of the one in the frame of the other.
        score: mean agreement per point, at most 1.
        ambiguity: score of the best pose elsewhere over that of this one.
        at_edge: the best pose lies at the border of the search: the true one may lie outside.
        covariance: (3, 3) of the pose: wide where the match slides (along a corridor).
    """

    pose: FloatArray
    score: float
    ambiguity: float
    at_edge: bool
    covariance: FloatArray


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


def match(
    query: Submap,
    reference: Submap,
    guess: FloatArray,
    reach: float,
    turn_reach: float,
    config: MatchingConfig | None = None,
) -> Match | None:
    """The best pose of `query` in the frame of `reference` near `guess`; None without points.

    Args:
        query: whose points are compared.
        reference: whose density they are compared with.
        guess: (3,) middle of the search.
        reach: how far to search in x and y (m).
        turn_reach: how far to search in heading (rad).
        config: parameters.
    """
    config = config or MatchingConfig()
    if query.weight <= 0 or len(reference.points) == 0:
        return None
    steps = max(1, math.ceil(reach / config.cell))
    turns = max(1, math.ceil(turn_reach / config.turn_step))
    headings = guess[2] + config.turn_step * np.arange(-turns, turns + 1)
    scores = _correlate(
        reference.density, reference.corner, config.cell, query.points, query.views,
        np.hypot(query.views[:, 0], query.views[:, 1]), guess, headings, steps,
    )  # fmt: skip
    scores /= query.weight
    return _best(scores, guess, headings, steps, config)


def _best(
    scores: Float32Array,
    guess: FloatArray,
    headings: FloatArray,
    steps: int,
    config: MatchingConfig,
) -> Match:
    """The peak of the score volume (headings, x, y), refined by a parabola along each axis."""
    peak = tuple(int(p) for p in np.unravel_index(int(scores.argmax()), scores.shape))
    best = float(scores[peak])
    shift = [_parabola_top(scores, peak, axis) for axis in range(3)]
    pose = np.array(
        [
            guess[0] + (peak[1] - steps + shift[1]) * config.cell,
            guess[1] + (peak[2] - steps + shift[2]) * config.cell,
            headings[peak[0]] + shift[0] * config.turn_step,
        ]
    )
    at_edge = any(p in (0, n - 1) for p, n in zip(peak, scores.shape, strict=True))
    covariance = _covariance(scores, peak, best, config)
    around = tuple(
        slice(max(0, p - config.peak_exclusion), p + config.peak_exclusion + 1) for p in peak
    )
    scores[around] = 0.0
    second = float(scores.max())
    return Match(pose, best, second / best if best > 0 else 1.0, at_edge, covariance)


def _parabola_top(scores: Float32Array, peak: tuple[int, ...], axis: int) -> float:
    """How far off the lattice (in steps) the top lies along an axis."""
    if not 0 < peak[axis] < scores.shape[axis] - 1:
        return 0.0
    low, high = (
        float(scores[tuple(p + side * (k == axis) for k, p in enumerate(peak))]) for side in (-1, 1)
    )
    bend = low - 2 * float(scores[peak]) + high
    return 0.5 * (low - high) / bend if bend < 0 else 0.0


def _covariance(
    scores: Float32Array, peak: tuple[int, ...], best: float, config: MatchingConfig
) -> FloatArray:
    """Spread (3, 3) in x, y, heading of the poses that score nearly as well (Olson 2009)."""
    likely = np.exp(config.sharpness * (scores - best))
    turn, x, y = np.nonzero(likely > config.likely)
    weight = likely[turn, x, y]
    offset = np.stack(
        (
            (x - peak[1]) * config.cell,
            (y - peak[2]) * config.cell,
            (turn - peak[0]) * config.turn_step,
        ),
        axis=1,
    )
    spread = np.asarray((offset * weight[:, None]).T @ offset / weight.sum())
    floor = np.array([config.position_floor, config.position_floor, config.heading_floor])
    return spread + np.diag(floor**2)


def transform_each(poses: FloatArray, points: FloatArray) -> FloatArray:
    """Points (M, 2), each of the frame of its own pose (M, 3), in the frame of the poses."""
    c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    x, y = points[:, 0], points[:, 1]
    return np.stack((poses[:, 0] + c * x - s * y, poses[:, 1] + s * x + c * y), axis=1)


def unit(vectors: FloatArray) -> FloatArray:
    """Vectors (M, 2) of length 1; zero stays zero."""
    return np.asarray(vectors / np.maximum(np.hypot(vectors[:, 0], vectors[:, 1]), 1e-9)[:, None])


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


@numba.njit(cache=True)
def _correlate(density, corner, cell, points, views, weights, guess, headings, steps):  # type: ignore[no-untyped-def]
    """Scores (headings, 2 steps + 1, 2 steps + 1) of all poses of the lattice around the guess."""
    side = 2 * steps + 1
    scores = np.zeros((len(headings), side, side), np.float32)
    rows, cols = density.shape[0], density.shape[1]
    for a in range(len(headings)):
        c, s = math.cos(headings[a]), math.sin(headings[a])
        for k in range(len(points)):
            x = guess[0] + c * points[k, 0] - s * points[k, 1] - corner[0]
            y = guess[1] + s * points[k, 0] + c * points[k, 1] - corner[1]
            vx = np.float32(c * views[k, 0] - s * views[k, 1])
            vy = np.float32(s * views[k, 0] + c * views[k, 1])
            w = np.float32(weights[k])
            u = int(math.floor(x / cell)) - steps
            v = int(math.floor(y / cell)) - steps
            low_j, high_j = max(0, -v), min(side, cols - v)
            for i in range(max(0, -u), min(side, rows - u)):
                for j in range(low_j, high_j):
                    here = density[u + i, v + j]
                    scores[a, i, j] += vx * here[0] + vy * here[1] + w * here[2]
    return scores


def points_of_stretch(
    points: ReflectionPoints, length: FloatArray, start: float, stop: float
) -> slice:
    """Which points were seen between `start` and `stop` metres of travel (`length`: (N,) at scans)."""
    at = length[points.scan]
    return slice(int(np.searchsorted(at, start)), int(np.searchsorted(at, stop)))


def points_from(
    points: ReflectionPoints, poses: FloatArray, anchor: int, part: slice
) -> tuple[FloatArray, FloatArray]:
    """The points `part` (M, 2) and their unit views (M, 2) in the frame of the scan `anchor`."""
    local = compose(inverse(poses[anchor]), poses[points.scan[part]])
    seen = transform_each(local, points.point[part])
    return seen, unit(seen - transform_each(local, points.sonar[part]))


def points_in_world(points: ReflectionPoints, poses: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Reflecting points (M, 2) and unit view directions (M, 2) in the frame of the poses (N, 3)."""
    at = poses[points.scan]
    seen = transform_each(at, points.point)
    return seen, unit(seen - transform_each(at, points.sonar))
