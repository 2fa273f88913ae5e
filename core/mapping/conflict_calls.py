"""Compiled: the queue of readings to look at again, and the cells that readings watch."""
# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import numba

from core.mapping.conflict_ledger import NOBODY


@numba.njit(cache=True)
def call(i, since, queue):
    """Reading i is to be looked at again, because something differs from round `since` on."""
    at = queue.since[i]
    if at != NOBODY:
        if at <= since:
            return
        _leave(i, queue)
    tail = queue.last[since]
    queue.since[i] = since
    queue.before[i], queue.after[i] = tail, NOBODY
    if tail == NOBODY:
        queue.first[since] = i
    else:
        queue.after[tail] = i
    queue.last[since] = i


@numba.njit(cache=True)
def _leave(i, queue):
    before, after = queue.before[i], queue.after[i]
    if before == NOBODY:
        queue.first[queue.since[i]] = after
    else:
        queue.after[before] = after
    if after == NOBODY:
        queue.last[queue.since[i]] = before
    else:
        queue.before[after] = before
    queue.since[i] = NOBODY


@numba.njit(cache=True)
def next_called(queue):
    """The reading that is called for the earliest round; NOBODY if none is."""
    for since in range(len(queue.first)):
        i = queue.first[since]
        if i != NOBODY:
            _leave(i, queue)
            return i
    return NOBODY


@numba.njit(cache=True)
def watch(i, cell, cells, beams):
    """Reading i is to be called when the cell is no longer uncovered; NOBODY: not any more."""
    old = beams.watched[i]
    if old == cell:
        return
    if old != NOBODY:
        before, after = beams.before[i], beams.after[i]
        if before == NOBODY:
            cells.watcher[old] = after
        else:
            beams.after[before] = after
        if after != NOBODY:
            beams.before[after] = before
    beams.watched[i] = cell
    if cell == NOBODY:
        return
    head = cells.watcher[cell]
    beams.before[i], beams.after[i] = NOBODY, head
    if head != NOBODY:
        beams.before[head] = i
    cells.watcher[cell] = i
