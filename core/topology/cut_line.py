"""Cutting a region in two along a line that a person has drawn, or the geometric reason why not."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy import ndimage
from skimage.draw import line as cells_between

from core.errors import InputError, ModelError
from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping import GridGeometry

STEP = 0.5
"""Grids between two looks along the extension of a line."""


@dataclass(frozen=True)
class CutConfig:
    """What a drawn line may do.

    Attributes:
        smallest_piece_m2: a piece below it is no place: about the floor that a robot of 0.22 m
            radius stands on (the paper's robot).
        farthest_extension_m: how far an end inside the region is drawn on, straight, to its border;
            nobody clicks exactly on a wall.
        nearest_border_m: where there is none straight on, how far beside the end it may be (the
            corner of a wall that was just missed).
        farthest_point_m: a coordinate beyond it cannot be meant.
        same_point_m: points nearer than this are one.
    """

    smallest_piece_m2: float = 0.15
    farthest_extension_m: float = 1.0
    nearest_border_m: float = 0.5
    farthest_point_m: float = 1e6
    same_point_m: float = 1e-3


def cut_region(
    region: BoolArray,
    geometry: GridGeometry,
    line: FloatArray,
    name: str,
    config: CutConfig | None = None,
) -> BoolArray:
    """The smaller piece (rows, cols) of a region that a line cuts in two; both are 4-connected.

    The floor under the line, and slivers beside it, go to the smaller piece where they touch it,
    else to the larger one: none is lost.

    Args:
        region: (rows, cols), 4-connected.
        line: (n, 2) world points of the line's corners, n >= 2.
        name: what errors call the region.

    Raises:
        InputError: the line is none.
        ModelError: it does not cut the region in two; the message says why.
    """
    config = config or CutConfig()
    _check(line, name, config)
    rows, cols = np.nonzero(region)
    low = np.array([rows.min(), cols.min()]) - 1
    high = np.array([rows.max(), cols.max()]) + 2
    window = np.zeros(high - low, bool)
    window[rows - low[0], cols - low[1]] = True
    ends_inside, corners = _extended(line, window, geometry, low, config)
    barrier = _drawn(corners, window.shape) & window
    if not barrier.any():
        raise ModelError(f"the line misses {name}: draw it across the region")
    smaller = _smaller_piece(window, barrier, ends_inside, geometry.cell_area, name, config)
    out = np.zeros(region.shape, bool)
    out[low[0] + 1 : high[0] - 1, low[1] + 1 : high[1] - 1] = smaller[1:-1, 1:-1]
    return out


def _check(line: FloatArray, name: str, config: CutConfig) -> None:
    if line.ndim != 2 or line.shape[1] != 2 or len(line) < 2:
        raise InputError("line: give at least two points [x, y]")
    if not np.isfinite(line).all() or np.abs(line).max() > config.farthest_point_m:
        raise InputError("line: a point is not in this world")
    if np.hypot(*(line - line[0]).T).max() < config.same_point_m:
        raise InputError(f"line: all its points are one; draw it across {name}")


def _smaller_piece(
    region: BoolArray,
    barrier: BoolArray,
    ends_inside: bool,
    cell_area: float,
    name: str,
    config: CutConfig,
) -> BoolArray:
    pieces, count = ndimage.label(region & ~barrier)
    sizes = np.bincount(pieces.ravel(), minlength=count + 1)[1:]
    areas = np.asarray(sizes * cell_area, float)
    large = np.flatnonzero(areas >= config.smallest_piece_m2) + 1
    if len(large) > 2:
        raise ModelError(
            f"the line cuts {name} into {len(large)} pieces, not two: let it cross the region once"
        )
    if len(large) < 2:
        raise ModelError(_why_not(areas, ends_inside, name, config))
    larger, smaller = sorted((int(piece) for piece in large), key=lambda piece: -areas[piece - 1])
    rest, _ = ndimage.label(region & (pieces != larger))
    return np.asarray(rest == rest[pieces == smaller][0])


def _why_not(areas: FloatArray, ends_inside: bool, name: str, config: CutConfig) -> str:
    """Why fewer than two pieces of a sufficient size are left."""
    if ends_inside:
        return (
            f"the line ends inside {name}, more than {config.farthest_extension_m:g} m from its "
            "border: draw it from border to border"
        )
    if len(areas) > 1 or not len(areas):
        least = np.sort(areas)[-2] if len(areas) > 1 else 0.0
        return (
            f"the line leaves a piece of {least:.2f} m² of {name}, less than "
            f"{config.smallest_piece_m2:g} m²: draw it farther from the border"
        )
    return (
        f"the line does not part {name}: it only touches its border, or one can walk round it "
        "inside the region"
    )


def _extended(
    line: FloatArray, window: BoolArray, geometry: GridGeometry, low: IntArray, config: CutConfig
) -> tuple[bool, FloatArray]:
    """The line with ends inside the region brought to its border, in cells of the window (n, 2).

    Also whether an end stayed inside all the same.
    """
    points = [line[0]]
    for point in line[1:]:
        if np.hypot(*(point - points[-1])) >= config.same_point_m:
            points.append(point)
    inside = False
    for end, before in ((0, 1), (-1, -2)):
        direction = points[end] - points[before]
        direction = direction / np.linalg.norm(direction)
        reach = config.farthest_extension_m / geometry.resolution
        travel = np.arange(0, reach + STEP, STEP)[:, None] * geometry.resolution
        path = points[end] + travel * direction
        outside = np.flatnonzero(~_within(window, geometry.cell_of(path) - low))
        border = geometry.world_of(np.argwhere(~window) + low)
        beside = np.hypot(*(border - points[end]).T)
        if len(outside):
            points[end] = path[outside[0]]
        elif beside.min() <= config.nearest_border_m:
            corner = border[int(beside.argmin())]
            points = [corner, *points] if end == 0 else [*points, corner]
        else:
            inside = True
    return inside, (geometry.cell_of(np.array(points)) - low).astype(float)


def _within(window: BoolArray, cells: IntArray) -> BoolArray:
    """Which cells (n, 2) of the window belong to the region."""
    clipped = np.clip(cells, 0, np.array(window.shape) - 1)
    return np.asarray(window[clipped[:, 0], clipped[:, 1]] & (clipped == cells).all(axis=1))


def _drawn(corners: FloatArray, shape: tuple[int, ...]) -> BoolArray:
    """The cells under a line: 8-connected, so that no 4-connected way leads through it."""
    image = np.zeros(shape, bool)
    for a, b in pairwise(corners):
        part = _clipped(a, b, np.array(shape) - 1.0)
        if part is not None:
            image[cells_between(*part[0], *part[1])] = True  # type: ignore[no-untyped-call]
    return image


def _clipped(a: FloatArray, b: FloatArray, last: FloatArray) -> tuple[IntArray, IntArray] | None:
    """The part of a segment between cells 0 and `last`; None when it passes by."""
    way = b - a
    with np.errstate(divide="ignore", invalid="ignore"):
        bounds = np.sort(np.stack((-a / way, (last - a) / way)), axis=0)
    still = way == 0
    if (still & ((a < 0) | (a > last))).any():
        return None
    enter = max(0.0, float(bounds[0][~still].max(initial=0.0)))
    leave = min(1.0, float(bounds[1][~still].min(initial=1.0)))
    if enter > leave:
        return None
    ends = np.rint(np.stack((a + enter * way, a + leave * way))).astype(np.int64)
    ends = np.clip(ends, 0, last.astype(np.int64))
    return ends[0], ends[1]
