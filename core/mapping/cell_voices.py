"""Compiled: who calls a cell empty, how loudly, and until which round (see incremental_cemal.py)."""
# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import numba
import numpy as np

from core.mapping.beam_footprint import NEAREST, cells_of_beam
from core.mapping.conflict_ledger import CHUNK, LOUDEST, NEVER, NOBODY, NOT_YET, TILE


@numba.njit(cache=True)
def loudest(cell, t, empty, empty_by, end):
    """Most pressure of the named who call the cell empty in round t, and until when (0, NEVER: none)."""
    for k in range(LOUDEST):
        p = empty[cell, k]
        if p <= 0:
            break
        last = end[empty_by[cell, k]]
        if last >= t:
            return p, min(last + 1, NEVER)
    return np.float32(0), NEVER


@numba.njit(cache=True)
def ask_around(cell, limits, cells, beams, reach_of, sensor):
    """Names those who matter in a cell: each is louder than all that outlive it; then the loudest."""
    cells.stale[cell] = False
    cells.chosen[cell] = True
    head = reach_of.head[tile_of(cell, sensor[3][1])]
    loudest = np.zeros(NEVER + 1, np.float32)
    who = np.full(NEVER + 1, NOBODY, np.int32)
    chunk = head
    x, y = centre_of(cell, sensor[2], sensor[3])
    pose, axis, range_m, sonar, gain = beams.pose, beams.axis, beams.range_m, beams.sonar, sensor[1]
    end_of, items, filled, following = (
        beams.end,
        reach_of.items,
        reach_of.filled,
        reach_of.following,
    )
    while chunk != NOBODY:
        for k in range(filled[chunk]):
            i = items[chunk, k]
            end = end_of[i]
            if end == NOT_YET:
                continue
            p = np.float32(pressure_at(i, x, y, limits[0], pose, axis, range_m, sonar, gain))
            if p > loudest[end]:
                loudest[end], who[end] = p, i
        chunk = following[chunk]
    cells.empty[cell, :] = 0
    cells.more[cell] = 0
    highest = np.float32(0)
    count = 0
    for back in range(NEVER + 1):
        end = NEVER - back
        if loudest[end] > highest and count < LOUDEST:
            highest = loudest[end]
            for m in range(count, 0, -1):
                cells.empty[cell, m] = cells.empty[cell, m - 1]
                cells.empty_by[cell, m] = cells.empty_by[cell, m - 1]
            cells.empty[cell, 0] = highest
            cells.empty_by[cell, 0] = who[end]
            count += 1


@numba.njit(cache=True)
def matters_since(i, cell, p, old, new, empty, empty_by, more, chosen, stale, end_of):
    """The first round in which the loudest voice of the cell may be another, as i's end has moved.

    Keeps the cell's names up to date on the way.
    """
    low, high = min(old, new) + 1, max(old, new)
    if old == NOT_YET and not chosen[cell]:
        insert(cell, p, i, empty, empty_by, more)
    named = False
    for k in range(LOUDEST):
        q = empty[cell, k]
        if q <= 0:
            break
        by = empty_by[cell, k]
        if by == i:
            named = True
        elif q >= p and not stale[cell]:
            low = max(low, end_of[by] + 1)
    if low <= high and chosen[cell] and (not named or new < old):
        stale[cell] = True
    return low


@numba.njit(cache=True)
def covered_until(cell, without, empty, empty_by, end_of):
    """The last round in which one of the named calls the cell empty, one reading left aside."""
    last = NOT_YET
    for k in range(LOUDEST):
        if empty[cell, k] <= 0:
            break
        if empty_by[cell, k] != without:
            last = max(last, end_of[empty_by[cell, k]])
    return last


@numba.njit(cache=True)
def insert(cell, pressure, i, empty, empty_by, more):
    """Names a new voice among the loudest of a cell, or counts it."""
    n = 0
    while n < LOUDEST and empty[cell, n] > 0:
        n += 1
    if n == LOUDEST:
        more[cell] += 1
        if pressure <= empty[cell, n - 1]:
            return
        n -= 1
    while n > 0 and empty[cell, n - 1] < pressure:
        empty[cell, n] = empty[cell, n - 1]
        empty_by[cell, n] = empty_by[cell, n - 1]
        n -= 1
    empty[cell, n] = pressure
    empty_by[cell, n] = i


@numba.njit(cache=True)
def loudest_shown(cell, limits, beams, reach_of, sensor):
    """Most pressure of the readings on the map that free a cell."""
    chunk = reach_of.head[tile_of(cell, sensor[3][1])]
    x, y = centre_of(cell, sensor[2], sensor[3])
    pose, axis, range_m, sonar, gain = beams.pose, beams.axis, beams.range_m, beams.sonar, sensor[1]
    shown, items, filled, following = (
        beams.shown,
        reach_of.items,
        reach_of.filled,
        reach_of.following,
    )
    loudest = 0.0
    while chunk != NOBODY:
        for k in range(filled[chunk]):
            i = items[chunk, k]
            if shown[i]:
                p = pressure_at(i, x, y, limits[1], pose, axis, range_m, sonar, gain)
                loudest = max(loudest, p)
        chunk = following[chunk]
    return loudest


@numba.njit(cache=True)
def pressure_at(i, x, y, clearance, pose, axis, range_m, sonar, gain):
    """Eq. (4) of a reading at a point that it calls empty; 0 where it does not."""
    dx, dy = x - pose[i, 0], y - pose[i, 1]
    squared = dx * dx + dy * dy
    reach = range_m[i] - clearance
    if reach <= 0 or squared > reach * reach:
        return 0.0
    along = dx * axis[i, 0] + dy * axis[i, 1]
    if along <= 0 or along * along < axis[i, 2] * squared:
        return 0.0
    off_axis = (1 - along * along / squared) / (1 - axis[i, 2])
    return gain[sonar[i], int(off_axis * (gain.shape[1] - 1) + 0.5)] / max(squared, NEAREST**2)


@numba.njit(cache=True)
def in_arc(i, x, y, thickness, pose, axis, range_m):
    """Whether the arc of a reading covers a point."""
    dx, dy = x - pose[i, 0], y - pose[i, 1]
    squared = dx * dx + dy * dy
    far, near = range_m[i] + thickness, max(range_m[i] - thickness, 0.0)
    if squared > far * far or squared < near * near:
        return False
    along = dx * axis[i, 0] + dy * axis[i, 1]
    return along > 0 and along * along >= axis[i, 2] * squared


@numba.njit(cache=True)
def centre_of(cell, frame, shape):
    """World position of the centre of a cell."""
    return (
        frame[0] + (cell % shape[1] + 0.5) * frame[2],
        frame[1] + (cell // shape[1] + 0.5) * frame[2],
    )


@numba.njit(cache=True)
def enlist(tiles, tile, i):
    """Notes in a tile's list, once, that a reading reaches it."""
    if tiles.stamp[tile] == i:
        return
    tiles.stamp[tile] = i
    chunk = tiles.head[tile]
    if chunk == NOBODY or tiles.filled[chunk] == CHUNK:
        fresh = tiles.used[0]
        tiles.used[0] += 1
        tiles.following[fresh] = chunk
        tiles.head[tile] = fresh
        chunk = fresh
    tiles.items[chunk, tiles.filled[chunk]] = i
    tiles.filled[chunk] += 1


@numba.njit(cache=True)
def cells_of(i, limits, beams, sensor, scratch):
    """Fills `scratch` with the cells of a reading, its arc included; returns their number."""
    half, gain, frame, shape = sensor
    s = beams.sonar[i]
    return cells_of_beam(
        beams.pose[i],
        beams.range_m[i] + limits[2],
        half[s],
        gain[s],
        frame,
        shape,
        scratch[0],
        scratch[1],
        scratch[2],
    )


@numba.njit(cache=True)
def tile_of(cell, cols):
    """Flat number of the tile of a flat cell number."""
    return (cell // cols // TILE) * (cols // TILE) + cell % cols // TILE
