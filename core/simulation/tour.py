"""Tours: where a robot goes on a mapping tour and on a localization drive."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from core.geometry import FloatArray, IntArray
from core.simulation.home import Home
from core.simulation.route_planner import RoutePlanner

SPACING = 1.5
"""A mapping tour comes within about this of every place it can reach (m)."""
ALREADY_SEEN = 0.7
"""A goal this near (m) to the way driven so far is left out."""
EASE = 0.42
"""Goals keep this far from everything (m), in rooms that have such places."""
ROAM_APART = 2.0
"""Goals of a random drive are at least this far apart (m)."""


def random_pose(planner: RoutePlanner, rng: np.random.Generator) -> FloatArray:
    """A pose (3,) anywhere that the robot can stand."""
    cells = planner.passable_cells()
    x, y = planner.geometry.world_of(cells[rng.integers(len(cells))])
    return np.array([x, y, rng.uniform(-np.pi, np.pi)])


def mapping_goals(
    home: Home, planner: RoutePlanner, start: FloatArray, rng: np.random.Generator
) -> list[FloatArray]:
    """Goals (2,) that together visit every part of every room, room by room, and end at the start."""
    goals: list[FloatArray] = []
    at = np.asarray(start[:2], float)
    for room in _rooms_in_order(home, planner, at):
        cells = planner.passable_cells()
        inside = cells[planner.truth.rooms[cells[:, 0], cells[:, 1]] == room]
        easy = inside[planner.clearance[inside[:, 0], inside[:, 1]] >= EASE]
        inside = easy if len(easy) else inside
        waiting = planner.geometry.world_of(_spread(inside, planner, rng))
        while len(waiting):
            nearest = int(np.hypot(*(waiting - at).T).argmin())
            at = waiting[nearest]
            goals.append(at)
            waiting = np.delete(waiting, nearest, axis=0)
    return [*goals, np.asarray(start[:2], float)]


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


def _spread(cells: IntArray, planner: RoutePlanner, rng: np.random.Generator) -> IntArray:
    """Cells of a room that lie SPACING apart and leave no cell farther than that from all of them."""
    if not len(cells):
        return cells
    centres = planner.geometry.world_of(cells)
    chosen = [int(rng.integers(len(cells)))]
    distance = np.hypot(*(centres - centres[chosen[0]]).T)
    while distance.max() > SPACING:
        chosen.append(int(distance.argmax()))
        distance = np.minimum(distance, np.hypot(*(centres - centres[chosen[-1]]).T))
    return np.asarray(cells[chosen])


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
