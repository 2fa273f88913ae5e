"""The compiled loops of incremental CEMAL; `incremental_cemal.py` tells what they are for."""
# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import numba
import numpy as np

from core.mapping.cell_voices import cells_of, enlist, loudest_shown, tile_of
from core.mapping.conflict_calls import call, next_called, watch
from core.mapping.conflict_ledger import NEVER, NOBODY, SEGMENTS
from core.mapping.conflict_spread import spread
from core.mapping.conflict_timeline import timeline
from core.mapping.conflict_wins import rewrite_wins, wins_differ


@numba.njit(cache=True)
def settle(
    first, last, budget, spare, limits, cells, beams, arcs_of, reach_of, queue, sensor, scratch
):
    """Takes in the readings first..last (half-open) and brings the timelines up to date.

    Args:
        spare: free chunks that the lists of tiles must have before a reading is looked at.
        budget: at most so many readings are looked at; the others stay in the queue.
        limits: (3,) conflict clearance, free clearance, half thickness of the arc.
        sensor: half beams, gains, frame and shape of the grid.
        scratch: the three outputs of `cells_of_beam`.

    Returns how many readings were looked at, and whether it stopped for want of chunks.
    """
    for i in range(first, last):
        call(i, 0, queue)
    done, hungry = 0, False
    touched = np.empty(budget + 1, np.int32)
    n_touched = 0
    while done < budget:
        free_chunks = min(
            len(arcs_of.filled) - arcs_of.used[0], len(reach_of.filled) - reach_of.used[0]
        )
        if free_chunks < spare:
            hungry = True
            break
        i = next_called(queue)
        if i == NOBODY:
            break
        done += 1
        if _update(i, limits, cells, beams, arcs_of, reach_of, queue, sensor, scratch):
            touched[n_touched] = i
            n_touched += 1
    _show(touched[:n_touched], limits, cells, beams, sensor, scratch)
    return done, hungry


@numba.njit(cache=True)
def _update(i, limits, cells, beams, arcs_of, reach_of, queue, sensor, scratch):
    """Works out a reading's timeline anew and tells whom it concerns; True if its end has moved."""
    n = cells_of(i, limits, beams, sensor, scratch)
    arc = np.empty(n, np.int32)
    n_arc = 0
    for k in range(n):
        if scratch[1][k] >= beams.range_m[i] - limits[2]:
            arc[n_arc] = k
            n_arc += 1
    win_cell, win_loudness = np.empty(SEGMENTS, np.int64), np.empty(SEGMENTS, np.float32)
    win_span = np.empty((SEGMENTS, 2), np.int16)
    end, opened, gap, wins = timeline(
        i,
        n,
        arc[:n_arc],
        limits,
        cells,
        beams,
        reach_of,
        sensor,
        scratch,
        win_cell,
        win_span,
        win_loudness,
    )
    old_end = beams.end[i]
    beams.opened[i] = opened
    watch(i, gap if opened == 0 else NOBODY, cells, beams)
    if opened > 0 and not beams.listed[i]:
        beams.listed[i] = True
        for k in arc[:n_arc]:
            enlist(arcs_of, tile_of(scratch[0][k], sensor[3][1]), i)
    if wins_differ(i, wins, win_cell, win_span, beams):
        rewrite_wins(
            i,
            wins,
            win_cell,
            win_span,
            win_loudness,
            limits,
            cells,
            beams,
            reach_of,
            queue,
            sensor,
        )
    if end == old_end:
        return False
    beams.end[i] = end
    spread(i, n, old_end, limits, cells, beams, arcs_of, reach_of, queue, sensor, scratch)
    return True


@numba.njit(cache=True)
def _show(touched, limits, cells, beams, sensor, scratch):
    """Puts readings that now survive on the map, and takes others off it."""
    for i in touched:
        survives = beams.end[i] == NEVER
        if survives == beams.shown[i]:
            continue
        beams.shown[i] = survives
        sign = 1 if survives else -1
        n = cells_of(i, limits, beams, sensor, scratch)
        reach = beams.range_m[i]
        for k in range(n):
            cell, d = scratch[0][k], scratch[1][k]
            if d <= reach - limits[1]:
                cells.free[cell] += sign
                cells.loudest_known[cell] = False
            if d >= reach - limits[2]:
                cells.arcs[cell] += sign
                cells.arc_pressure[cell] += sign * scratch[2][k]


@numba.njit(cache=True)
def defended_cells(count, limits, cells, beams, reach_of, sensor, scratch):
    """Pressure with which readings defend cells that the map would call free (as batch CEMAL)."""
    defended = np.zeros(len(cells.free))
    for i in range(count):
        seen = beams.seen_at[i]
        if not beams.shown[i] or (seen != NOBODY and cells.free[seen] == 0):
            continue
        n = cells_of(i, limits, beams, sensor, scratch)
        near = beams.range_m[i] - limits[2]
        best, best_ratio, loudness = NOBODY, 0.0, 0.0
        beams.seen_at[i] = NOBODY
        for k in range(n):
            if scratch[1][k] >= near and cells.free[scratch[0][k]] == 0:
                beams.seen_at[i] = scratch[0][k]
                break
        if beams.seen_at[i] != NOBODY:
            continue
        for k in range(n):
            if scratch[1][k] < near:
                continue
            cell, p = scratch[0][k], scratch[2][k]
            if not cells.loudest_known[cell]:
                cells.loudest[cell] = loudest_shown(cell, limits, beams, reach_of, sensor)
                cells.loudest_known[cell] = True
            ratio = p / cells.loudest[cell]
            if ratio > best_ratio:
                best, best_ratio, loudness = cell, ratio, p
        if best_ratio >= 1:
            defended[best] = max(defended[best], loudness)
    return defended
