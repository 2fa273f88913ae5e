"""Tours: where a robot goes on a mapping tour and on a localization drive."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from scipy.spatial import cKDTree

from core.geometry import FloatArray
from core.simulation.home import Home
from core.simulation.route_planner import RoutePlanner

NEAR_ENOUGH = 0.85
"""A mapping tour comes this near to every place that it can reach (m)."""
ROAM_APART = 2.0
"""Goals of a random drive are at least this far apart (m)."""


def random_pose(planner: RoutePlanner, rng: np.random.Generator) -> FloatArray:
    """A pose (3,) anywhere that the robot can stand."""
    cells = planner.passable_cells()
    x, y = planner.geometry.world_of(cells[rng.integers(len(cells))])
    return np.array([x, y, rng.uniform(-np.pi, np.pi)])


def mapping_goals(
    home: Home, planner: RoutePlanner, driven: Callable[[], FloatArray]
) -> Iterator[FloatArray]:
    """Goals (2,) that together come near to every part of every room, room by room.

    Args:
        home: for its doors.
        planner: for where the robot can be.
        driven: gives the true positions (N, 2) so far; asked again before every goal.
    """
    for room in _rooms_in_order(home, planner, driven()[-1]):
        places = _places_in(room, planner)
        given_up = np.zeros(len(places), np.bool_)
        while True:
            distance, _ = cKDTree(driven()).query(places) if len(places) else (np.zeros(0), None)
            missed = np.flatnonzero((distance > NEAR_ENOUGH) & ~given_up)
            if not len(missed):
                break
            nearest = missed[np.hypot(*(places[missed] - driven()[-1]).T).argmin()]
            # a little beyond the nearest missed place, in the midst of the missed ones around it
            around = places[missed][np.hypot(*(places[missed] - places[nearest]).T) < NEAR_ENOUGH]
            goal = around[np.hypot(*(around - around.mean(axis=0)).T).argmin()]
            given_up[nearest] = True
            yield goal


def _places_in(room: int, planner: RoutePlanner) -> FloatArray:
    """All passable positions (N, 2) of a room, its corners too."""
    cells = planner.passable_cells()
    inside = cells[planner.truth.rooms[cells[:, 0], cells[:, 1]] == room]
    return planner.geometry.world_of(inside)


def roaming_goals(
    planner: RoutePlanner, start: FloatArray, rng: np.random.Generator
) -> Iterator[FloatArray]:
    """Endless random goals (2,), every room as likely as any other, each apart from the last."""
    cells = planner.passable_cells()
    centres = planner.geometry.world_of(cells)
    rooms = planner.truth.rooms[cells[:, 0], cells[:, 1]]
    numbers = np.unique(rooms[rooms > 0])
    at = np.asarray(start[:2], float)
    while True:
        inside = centres[rooms == rng.choice(numbers)]
        goal = inside[rng.integers(len(inside))]
        if np.hypot(*(goal - at)) < ROAM_APART and rng.random() < 0.9:
            continue
        at = goal
        yield goal


def _rooms_in_order(home: Home, planner: RoutePlanner, at: FloatArray) -> list[int]:
    """Room numbers in the order of a walk through the open doors, from the one at `at`."""
    row, col = planner.geometry.cell_of(at)
    number = {room.name: k for k, room in enumerate(home.rooms, 1)}
    first = int(planner.truth.rooms[row, col]) or 1
    order: list[int] = []
    stack = [first]
    while stack:
        room = stack.pop()
        if room in order:
            continue
        order.append(room)
        doors = [d for d in home.doors if d.name not in home.shut]
        behind = [(d, set(d.rooms) - {home.rooms[room - 1].name}) for d in doors]
        next_rooms = [
            (number[name], door.gap.centre)
            for door, names in behind
            if len(names) == 1
            for name in names
        ]
        next_rooms.sort(key=lambda item: -float(np.hypot(*(np.array(item[1]) - at))))
        stack += [k for k, _ in next_rooms if k not in order]
    return order
