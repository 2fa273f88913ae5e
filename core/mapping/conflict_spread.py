"""Incremental CEMAL: whom it concerns that a reading is dropped in another round than before."""
# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import numba
import numpy as np

from core.mapping.cell_voices import (
    centre_of,
    covered_until,
    enlist,
    in_arc,
    matters_since,
    tile_of,
)
from core.mapping.conflict_calls import call
from core.mapping.conflict_ledger import NEVER, NOBODY, NOT_YET
from core.mapping.conflict_wins import hangs_on


@numba.njit(cache=True)
def spread(i, n, old, limits, cells, beams, arcs_of, reach_of, queue, sensor, scratch):
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
