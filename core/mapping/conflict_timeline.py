"""Incremental CEMAL: what befalls one reading round by round while the others stand."""
# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import numba
import numpy as np

from core.mapping.cell_voices import ask_around, loudest
from core.mapping.conflict_ledger import LAST_OF_PHASE, MOST_ATTACKS, NEVER, NOBODY, PHASE, SEGMENTS
from core.mapping.conflict_wins import attacks_on, first_attack


@numba.njit(cache=True)
def timeline(
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
