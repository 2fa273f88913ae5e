"""Putting small cells together to few large regions that are convex: what bisection cannot do.

Cutting in two halves (`convex_division.py`) is balanced and never takes a border back. Here a region
is any connected group of cells with few enough hidden pairs, and the groups are chosen together: as
many pairs of places as possible that see each other and lie in one room are to lie in one region.
That is a correlation clustering with a limit; simulated annealing (Kirkpatrick et al., 1983) moves
one cell at a time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numba
import numpy as np

from core.geometry import BoolArray, FloatArray, IntArray
from core.segmentation.boundary_points import boundary_points
from core.segmentation.mutual_visibility import hidden_between


@dataclass(frozen=True)
class GroupingConfig:
    """What makes groups good. Worth is counted in pairs of square metres (m4).

    Attributes:
        most_hidden: share of hidden pairs that a region may have. Maps hold phantoms and miss
            walls: a little less than the .2 that regions should keep to in the home itself.
        hidden_cost: of a hidden pair in one region; a pair that sees each other is worth 1.
        apart_cost: of a pair of two suggested rooms in one region.
        excess_cost: of each hidden pair above the limit.
        least_area: square metres; what a region lacks costs `small_cost` each.
        least_border: metres along which a cell touches the region that it joins, unless it touches
            its own along less: regions do not reach through doorways.
        moves: tried per cell; `most_moves` in all. A fourth of them leaves a third of a region
            more in each home, three times as many gain nothing.
        hot, cold: first and last temperature (m4).
        founding: share of moves in which a cell founds a region.
    """

    most_hidden: float = 0.185
    hidden_cost: float = 1.5
    apart_cost: float = 1.0
    excess_cost: float = 20.0
    least_area: float = 2.0
    small_cost: float = 50.0
    least_border: float = 1.0
    moves: int = 15_000
    most_moves: int = 2_000_000
    hot: float = 30.0
    cold: float = 0.3
    founding: float = 0.05


def grouped(
    cells: IntArray,
    rooms: IntArray,
    blocked: BoolArray,
    resolution: float,
    config: GroupingConfig,
    rng: np.random.Generator,
) -> IntArray:
    """Label image (rows, cols) of connected regions 1..m, each a group of cells.

    Args:
        cells: label image of cells 1..n, 0 outside.
        rooms: label image of suggested rooms, 0 = none.
        blocked: what nobody sees through.
        resolution: metres per cell of the grid.
        config: what makes groups good.
        rng: draws the moves.
    """
    count = int(cells.max(initial=0))
    if count == 0:
        return np.zeros_like(cells)
    area = np.asarray(np.bincount(cells.ravel())[1:] * resolution**2, np.float64)
    pairs = np.outer(area, area)
    hidden = pairs * hidden_between(cells, blocked, resolution)
    room = _room_of(cells, rooms, count)
    together = room[:, None] == room
    worth = np.where(together, pairs - config.hidden_cost * hidden, -config.apart_cost * pairs)
    border = np.zeros((count, count))
    for (a, b), points in boundary_points(cells).items():
        border[a - 1, b - 1] = border[b - 1, a - 1] = len(points) * resolution
    limits = np.array(
        [config.most_hidden, config.excess_cost, config.least_area, config.small_cost]
    )
    moves = min(config.moves * count, config.most_moves)
    heat = config.hot * (config.cold / config.hot) ** (np.arange(moves) / moves)
    cuts = (config.least_border, config.founding)
    group = _annealed(area, hidden, worth, border, limits, heat, cuts, rng)
    number = np.concatenate(([0], np.unique(group, return_inverse=True)[1] + 1))
    return np.asarray(number[cells])


def _room_of(cells: IntArray, rooms: IntArray, count: int) -> IntArray:
    """The room (n,) that holds most of each cell."""
    votes = np.zeros((count + 1, int(rooms.max(initial=0)) + 1), np.int64)
    np.add.at(votes, (cells.ravel(), rooms.ravel()), 1)
    return np.asarray(votes[1:].argmax(axis=1))


@numba.njit(cache=True)
def _annealed(
    area: FloatArray,
    hidden: FloatArray,
    worth: FloatArray,
    border: FloatArray,
    limits: FloatArray,
    heat: FloatArray,
    cuts: tuple[float, float],
    rng: np.random.Generator,
) -> IntArray:
    """The best group (n,) of each cell that was come across; all cells start alone."""
    n = len(area)
    group, best = np.arange(n), np.arange(n)
    # Of each group: area, hidden pairs, worth.
    sums = np.stack((area, np.diag(hidden), np.diag(worth)), axis=1)
    now, highest = 0.0, 0.0
    for temperature in heat:
        cell = int(n * rng.random())
        source = group[cell]
        if rng.random() < cuts[1]:
            target = np.flatnonzero(sums[:, 0] == 0.0)[:1]
            target = target[0] if len(target) else source
        else:
            beside = np.flatnonzero(border[cell])
            target = group[beside[int(len(beside) * rng.random())]] if len(beside) else source
        if target == source:
            continue
        out, into, touch = _change(cell, source, target, group, area, hidden, worth, border)
        if sums[target, 0] > 0 and touch[1] < min(cuts[0], touch[0]):
            continue
        gain = _value(sums[source] - out, limits) - _value(sums[source], limits)
        gain += _value(sums[target] + into, limits) - _value(sums[target], limits)
        if gain < 0 and rng.random() >= np.exp(gain / temperature):
            continue
        if not _holds_together(cell, group, border):
            continue
        group[cell] = target
        sums[source] -= out
        sums[target] += into
        if not (group == source).any():
            sums[source] = 0.0
        now += gain
        if now > highest:
            highest, best = now, group.copy()
    return best


@numba.njit(cache=True)
def _change(
    cell: int,
    source: int,
    target: int,
    group: IntArray,
    area: FloatArray,
    hidden: FloatArray,
    worth: FloatArray,
    border: FloatArray,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """What a cell takes out of its group and into another (area, hidden, worth), borders to both."""
    out = np.array([area[cell], hidden[cell, cell], worth[cell, cell]])
    into, touch = out.copy(), np.zeros(2)
    for other in range(len(area)):
        if other == cell:
            continue
        if group[other] == source:
            out[1] += 2 * hidden[cell, other]
            out[2] += 2 * worth[cell, other]
            touch[0] += border[cell, other]
        elif group[other] == target:
            into[1] += 2 * hidden[cell, other]
            into[2] += 2 * worth[cell, other]
            touch[1] += border[cell, other]
    return out, into, touch


@numba.njit(cache=True)
def _value(sums: FloatArray, limits: FloatArray) -> float:
    """What a group (area, hidden pairs, worth) is worth within its limits."""
    area, hidden, worth = sums
    if area < 1e-9:
        return 0.0
    excess = max(0.0, hidden - limits[0] * area**2)
    small = max(0.0, limits[2] - area)
    return float(worth - limits[1] * excess - limits[3] * small)


@numba.njit(cache=True)
def _holds_together(cell: int, group: IntArray, border: FloatArray) -> bool:
    """Whether a group is connected without one of its cells."""
    left = group == group[cell]
    left[cell] = False
    members = np.flatnonzero(left)
    if len(members) < 2:
        return True
    waiting = [members[0]]
    left[members[0]] = False
    while waiting:
        at = waiting.pop()
        for other in members:
            if left[other] and border[at, other] > 0:
                left[other] = False
                waiting.append(other)
    return not left.any()
