"""The compiled loops of incremental CEMAL; `incremental_cemal.py` tells what they are for."""
# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import numba
import numpy as np

from core.mapping.cell_voices import (
    ask_around,
    cells_of,
    centre_of,
    covered_until,
    enlist,
    in_arc,
    loudest,
    loudest_shown,
    matters_since,
    tile_of,
)
from core.mapping.conflict_calls import call, next_called, watch
from core.mapping.conflict_ledger import (
    LAST_OF_PHASE,
    MOST_ATTACKS,
    NEVER,
    NOBODY,
    NOT_YET,
    PHASE,
    SEGMENTS,
)
from core.mapping.conflict_wins import attacks_on, first_attack, hangs_on, rewrite_wins, wins_differ


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
    end, opened, gap, wins = _timeline(
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
    _spread(i, n, old_end, limits, cells, beams, arcs_of, reach_of, queue, sensor, scratch)
    return True


@numba.njit(cache=True)
def _timeline(
    i,
    n,
    arc,
    limits,
    cells,
    beams,
    reach_of,
    sensor,
    scratch,
    win_cell,
    win_span,
    win_loudness,
):
    """What befalls a reading round by round, as the others stand.

    Returns the round in which it is dropped, the round from which on it is in no conflict and a cell
    that shows it, and how often it wins; cell, rounds and loudness of that go to the last arguments.
    """
    begins, ends = np.empty(MOST_ATTACKS, np.int16), np.empty(MOST_ATTACKS, np.int16)
    attacks = attacks_on(i, n, limits, cells, beams, scratch, begins, ends)
    empty, empty_by, end_of = cells.empty, cells.empty_by, beams.end
    more, chosen, stale = cells.more, cells.chosen, cells.stale
    wins, t = 0, 0
    while t < NEVER:
        best, best_ratio, loudness, until = NOBODY, 0.0, np.float32(0), NEVER
        for k in arc:
            cell, p = scratch[0][k], np.float32(scratch[2][k])
            most, gone = loudest(cell, t, empty, empty_by, end_of)
            if stale[cell] or (most <= 0 and more[cell] > 0 and not chosen[cell]):
                ask_around(cell, limits, cells, beams, reach_of, sensor)
                most, gone = loudest(cell, t, empty, empty_by, end_of)
            if most <= 0:
                return first_attack(t, NEVER, attacks, begins, ends), t, cell, wins
            until = min(until, gone)
            if p / most > best_ratio:
                best, best_ratio, loudness = cell, p / most, p
        if best == NOBODY:
            return first_attack(t, NEVER, attacks, begins, ends), t, NOBODY, wins
        if best_ratio < 1:
            end = min(first_attack(t, until, attacks, begins, ends), _sentence(t, until))
            if end < NEVER:
                return end, NEVER, NOBODY, wins
        elif wins < SEGMENTS:
            win_cell[wins], win_loudness[wins] = best, loudness
            win_span[wins, 0], win_span[wins, 1] = t, until
            wins += 1
        t = until
    return NEVER, NEVER, NOBODY, wins


@numba.njit(cache=True)
def _sentence(t, until):
    """The first round in t..until in which losers are dropped."""
    at = t // PHASE * PHASE + LAST_OF_PHASE
    return at if at < until else NEVER


@numba.njit(cache=True)
def _spread(i, n, old, limits, cells, beams, arcs_of, reach_of, queue, sensor, scratch):
    """The end of reading i has moved from round `old`: calls whoever that may concern."""
    new = beams.end[i]
    high = max(old, new)
    shape = sensor[3]
    empty, empty_by, end_of = cells.empty, cells.empty_by, beams.end
    more, chosen, stale = cells.more, cells.chosen, cells.stale
    changed, tiles = np.empty(n, np.int64), np.empty(n, np.int64)
    starts, covered = np.empty(n, np.int16), np.empty(n, np.int16)
    count = 0
    for k in range(n):
        cell, d = scratch[0][k], scratch[1][k]
        tile = tile_of(cell, shape[1])
        if old == NOT_YET and d <= beams.range_m[i] - limits[1]:
            enlist(reach_of, tile, i)
        if d > beams.range_m[i] - limits[0]:
            continue
        p = np.float32(scratch[2][k])
        since = matters_since(i, cell, p, old, new, empty, empty_by, more, chosen, stale, end_of)
        if since > high:
            continue
        starts[count], changed[count], tiles[count] = since, cell, tile
        covered[count] = covered_until(cell, i, empty, empty_by, end_of)
        count += 1
        if since == 0:
            w = cells.watcher[cell]
            while w != NOBODY:
                call(w, 0, queue)
                w = beams.after[w]
    done = np.zeros(count, np.bool_)
    for k in range(count):
        if not done[k]:
            _call_arcs(
                tiles[k],
                k,
                count,
                tiles,
                changed,
                starts,
                covered,
                done,
                new > old,
                limits,
                beams,
                arcs_of,
                queue,
                sensor,
            )


@numba.njit(cache=True)
def _call_arcs(
    tile,
    first,
    last,
    tiles,
    changed,
    starts,
    covered,
    done,
    louder,
    limits,
    beams,
    arcs_of,
    queue,
    sensor,
):
    """Calls the readings in conflict whose arcs cover changed cells of a tile, if that may matter."""
    pose, axis, range_m = beams.pose, beams.axis, beams.range_m
    opened, end_of, waiting = beams.opened, beams.end, queue.since
    items, filled, following = arcs_of.items, arcs_of.filled, arcs_of.following
    here = np.empty(last - first, np.int32)
    count, earliest = 0, NEVER
    for m in range(first, last):
        if tiles[m] == tile:
            done[m] = True
            here[count] = m
            count += 1
            earliest = min(earliest, starts[m])
    chunk = arcs_of.head[tile]
    while chunk != NOBODY:
        for j in range(filled[chunk]):
            other = items[chunk, j]
            latest = min(opened[other], end_of[other])
            if opened[other] == 0 or latest < earliest:
                continue
            for m in here[:count]:
                at = waiting[other]
                if latest < starts[m] or (0 <= at <= starts[m]):
                    continue
                if louder and not hangs_on(other, changed[m], starts[m], covered[m], beams):
                    continue
                x, y = centre_of(changed[m], sensor[2], sensor[3])
                if in_arc(other, x, y, limits[2], pose, axis, range_m):
                    call(other, starts[m], queue)
        chunk = following[chunk]


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
