"""What a sonar ought to read: the range of the nearest surface in its beam, for every place and direction.

This is the distance vector of eq. (12) with two changes: the map is computed once for *every* place
(a feature of the map, kept with the model), and a direction is as wide as the sonar's beam. The
surface is the border of the free space, so that a wall that the map has holes in still stops a ray.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np
import numpy.typing as npt

from core.geometry import BoolArray, FloatArray
from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import FREE, OCCUPIED, GridGeometry

ByteArray = npt.NDArray[np.uint8]

RANGE_STEP = 0.05
"""Metres per unit of the range codes."""
NOTHING = 127
"""Range code of 'no surface within reach'."""
OPEN = 128
"""Added to a range code where the surface is the border of the unknown, not an obstacle."""


@dataclass(frozen=True)
class ExpectedRangeConfig:
    """How expected ranges are made.

    Attributes:
        cell: metres between the places of the table.
        directions: directions of the table in a full turn.
        beam_share: share of the sonar's beam width that returns surfaces reliably.
        reach: metres that a ray is followed.
        border: fine cells of unknown ground that a ray may cross before it counts as stopped.
    """

    cell: float = 0.10
    directions: int = 144
    beam_share: float = 1.0
    reach: float = 6.0
    border: int = 2


@dataclass(frozen=True)
class ExpectedRanges:
    """Expected range codes of one beam width.

    Attributes:
        geometry: the places, coarser than the map.
        codes: (directions, rows, cols) of `RANGE_STEP` units, `NOTHING`, or `OPEN` + units;
            direction 0 looks along the grid's columns (x), growing counter-clockwise.
        standable: (rows, cols) where a robot's centre can be.
    """

    geometry: GridGeometry
    codes: ByteArray
    standable: BoolArray


def pose_geometry(grid: OccupancyGrid, cell: float) -> tuple[GridGeometry, int]:
    """The coarse grid of places and how many map cells one of them spans."""
    span = max(1, round(cell / grid.geometry.resolution))
    rows = -(-grid.geometry.shape[0] // span)
    cols = -(-grid.geometry.shape[1] // span)
    resolution = grid.geometry.resolution * span
    return GridGeometry(resolution, grid.geometry.origin, (rows, cols)), span


def coarse_mask(mask: BoolArray, shape: tuple[int, int], span: int) -> BoolArray:
    """Which coarse cells hold a true cell of a mask (rows, cols)."""
    padded = np.zeros((shape[0] * span, shape[1] * span), bool)
    padded[: mask.shape[0], : mask.shape[1]] = mask
    return np.asarray(padded.reshape(shape[0], span, shape[1], span).any(axis=(1, 3)))


def ray_codes(grid: OccupancyGrid, config: ExpectedRangeConfig) -> ExpectedRanges:
    """The range codes of single rays (no beam width) from every standable place."""
    geometry, span = pose_geometry(grid, config.cell)
    standable = coarse_mask(grid.free, geometry.shape, span)
    angles = 2 * math.pi * np.arange(config.directions) / config.directions
    codes = _cast(
        grid.state,
        standable,
        span,
        np.cos(angles),
        np.sin(angles),
        round(config.reach / grid.geometry.resolution),
        config.border,
        grid.geometry.resolution / RANGE_STEP,
    )
    return ExpectedRanges(geometry, codes, standable)


def beam_codes(rays: ExpectedRanges, beam_width: float, config: ExpectedRangeConfig) -> ByteArray:
    """The nearest surface within a beam of full angle `beam_width` (rad): (directions, rows, cols)."""
    step = 2 * math.pi / config.directions
    half = round(config.beam_share * beam_width / 2 / step)
    return _nearest_in_beam(rays.codes, half)


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _cast(
    state: ByteArray,
    standable: BoolArray,
    span: int,
    cos: FloatArray,
    sin: FloatArray,
    reach: int,
    border: int,
    units: float,
) -> ByteArray:
    rows, cols = standable.shape
    codes = np.zeros((cos.size, rows, cols), np.uint8)
    for r in range(rows):
        for c in range(cols):
            if not standable[r, c]:
                continue
            row, col = (r + 0.5) * span, (c + 0.5) * span
            for d in range(cos.size):
                codes[d, r, c] = _ray(state, row, col, sin[d], cos[d], reach, border, units)
    return codes


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _ray(
    state: ByteArray,
    row: float,
    col: float,
    d_row: float,
    d_col: float,
    reach: int,
    border: int,
    units: float,
) -> int:
    unknown = 0
    for step in range(2 * reach):
        along = 0.5 * (step + 1)
        i, j = int(row + along * d_row), int(col + along * d_col)
        inside = 0 <= i < state.shape[0] and 0 <= j < state.shape[1]
        if inside and state[i, j] == FREE:
            unknown = 0
            continue
        if inside and state[i, j] == OCCUPIED:
            return min(int((along - 0.5 * unknown) * units + 0.5), NOTHING - 1)
        unknown += 1
        if unknown > 2 * border:
            return OPEN + min(int((along - 0.5 * unknown) * units + 0.5), NOTHING - 1)
    return NOTHING


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _nearest_in_beam(codes: ByteArray, half: int) -> ByteArray:
    count, rows, cols = codes.shape
    out = np.empty_like(codes)
    for d in range(count):
        for r in range(rows):
            for c in range(cols):
                best = codes[d, r, c]
                for k in range(-half, half + 1):
                    code = codes[(d + k) % count, r, c]
                    if _nearer(code, best):
                        best = code
                out[d, r, c] = best
    return out


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _nearer(code: int, best: int) -> bool:
    """Whether a ray's surface answers before another's; an open border answers only alone."""
    is_open, best_open = code > NOTHING, best > NOTHING
    if is_open != best_open:
        return best_open if code != NOTHING else False
    return code < best
