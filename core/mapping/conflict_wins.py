"""Compiled: the rounds in which a reading wins its conflict, and whom it attacks then."""
# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import numba
import numpy as np

from core.mapping.cell_voices import centre_of, pressure_at, tile_of
from core.mapping.conflict_calls import call
from core.mapping.conflict_ledger import MOST_ATTACKS, NEVER, NOBODY, SEGMENTS


@numba.njit(cache=True)
def attacks_on(i, n, limits, cells, beams, scratch, begins, ends):
    """When winners speak louder than the reading at a cell that it calls empty."""
    count = 0
    reach = beams.range_m[i] - limits[0]
    for k in range(n):
        node = cells.guard[scratch[0][k]]
        if node == NOBODY or scratch[1][k] > reach:
            continue
        p = np.float32(scratch[2][k])
        while node != NOBODY:
            w, m = node // SEGMENTS, node % SEGMENTS
            if p < beams.win_loudness[w, m] and w != i and count < MOST_ATTACKS:
                begins[count], ends[count] = beams.win_span[w, m, 0], beams.win_span[w, m, 1]
                count += 1
            node = beams.win_after[w, m]
    return count


@numba.njit(cache=True)
def first_attack(t, until, count, begins, ends):
    """The first round in t..until (half-open) with an attack; NEVER if there is none."""
    first = NEVER
    for k in range(count):
        begin = max(begins[k], t)
        if begin < min(ends[k], until) and begin < first:
            first = begin
    return first


@numba.njit(cache=True)
def wins_differ(i, count, cell_of, span, beams):
    """Whether cells or rounds of the wins are not those that are noted."""
    if beams.win_count[i] != count:
        return True
    for m in range(count):
        if (
            beams.win_cell[i, m] != cell_of[m]
            or beams.win_span[i, m, 0] != span[m, 0]
            or beams.win_span[i, m, 1] != span[m, 1]
        ):
            return True
    return False


@numba.njit(cache=True)
def rewrite_wins(i, count, cell_of, span, loud, limits, cells, beams, reach_of, queue, sensor):
    """Replaces the rounds in which a reading wins, and calls those whom that spares or hits."""
    for m in range(beams.win_count[i]):
        same = m < count and (
            beams.win_cell[i, m] == cell_of[m]
            and beams.win_span[i, m, 0] == span[m, 0]
            and beams.win_span[i, m, 1] == span[m, 1]
        )
        _unlink(i, m, cells, beams)
        if not same:
            _call_attacked(i, m, True, limits, cells, beams, reach_of, queue, sensor)
    for m in range(count):
        same = m < beams.win_count[i] and (
            beams.win_cell[i, m] == cell_of[m]
            and beams.win_span[i, m, 0] == span[m, 0]
            and beams.win_span[i, m, 1] == span[m, 1]
        )
        beams.win_cell[i, m] = cell_of[m]
        beams.win_span[i, m, 0], beams.win_span[i, m, 1] = span[m, 0], span[m, 1]
        beams.win_loudness[i, m] = loud[m]
        node, head = i * SEGMENTS + m, cells.guard[cell_of[m]]
        beams.win_before[i, m], beams.win_after[i, m] = NOBODY, head
        if head != NOBODY:
            beams.win_before[head // SEGMENTS, head % SEGMENTS] = node
        cells.guard[cell_of[m]] = node
        if not same:
            _call_attacked(i, m, False, limits, cells, beams, reach_of, queue, sensor)
    beams.win_count[i] = count


@numba.njit(cache=True)
def _unlink(i, m, cells, beams):
    before, after = beams.win_before[i, m], beams.win_after[i, m]
    if before == NOBODY:
        cells.guard[beams.win_cell[i, m]] = after
    else:
        beams.win_after[before // SEGMENTS, before % SEGMENTS] = after
    if after != NOBODY:
        beams.win_before[after // SEGMENTS, after % SEGMENTS] = before


@numba.njit(cache=True)
def _call_attacked(i, m, spared, limits, cells, beams, reach_of, queue, sensor):
    """Calls those whose end a segment of winner i has caused (spared) or may cause.

    Whom another winner attacks at the same cell in all these rounds, it leaves alone.
    """
    cell, loudness = beams.win_cell[i, m], beams.win_loudness[i, m]
    begin, end = beams.win_span[i, m, 0], beams.win_span[i, m, 1]
    second = _loudest_beside(i, cell, begin, end, cells, beams)
    if second >= loudness:
        return
    chunk = reach_of.head[tile_of(cell, sensor[3][1])]
    x, y = centre_of(cell, sensor[2], sensor[3])
    pose, axis, range_m, sonar, gain = beams.pose, beams.axis, beams.range_m, beams.sonar, sensor[1]
    end_of, items, filled = beams.end, reach_of.items, reach_of.filled
    while chunk != NOBODY:
        for k in range(filled[chunk]):
            other = items[chunk, k]
            at = end_of[other]
            concerned = begin <= at < end if spared else at > begin
            if concerned and other != i:
                p = pressure_at(other, x, y, limits[0], pose, axis, range_m, sonar, gain)
                if p > 0 and second <= np.float32(p) < loudness:
                    call(other, begin, queue)
        chunk = reach_of.following[chunk]


@numba.njit(cache=True)
def _loudest_beside(i, cell, begin, end, cells, beams):
    """Most loudness with which another reading defends the cell in all rounds begin..end."""
    most = np.float32(0)
    node = cells.guard[cell]
    while node != NOBODY:
        w, m = node // SEGMENTS, node % SEGMENTS
        if w != i and beams.win_span[w, m, 0] <= begin and beams.win_span[w, m, 1] >= end:
            most = max(most, beams.win_loudness[w, m])
        node = beams.win_after[w, m]
    return most


@numba.njit(cache=True)
def hangs_on(i, cell, since, covered, beams):
    """Whether it may matter to a reading that a cell is called empty louder from a round on.

    A reading that loses goes on losing; one that wins elsewhere goes on winning there; one that is
    out of conflict stays so unless this cell was uncovered (`covered`: until which round it was not).
    """
    if covered < beams.opened[i] < NEVER:
        return True
    for m in range(beams.win_count[i]):
        if beams.win_cell[i, m] == cell and beams.win_span[i, m, 1] > since:
            return True
    return False
