"""Random floor plans of 4 to 10 rooms: along a corridor, around a bent corridor, or room to room."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from core.simulation.floor_plan import Box, Opening, Room, inner_borders

CORRIDOR = (1.25, 1.6)
"""Width of corridors from wall axis to wall axis (m)."""
BAND = (3.1, 4.0)
"""Depth of the rooms beside a corridor (m)."""
NARROWEST_ROOM = 2.3
"""Narrowest cell of a row of rooms (m)."""
SMALLEST_SIDE = 2.8
"""Shortest side of a room in plans without a corridor (m)."""
DOOR = (0.80, 0.95)
"""Width of doors (m)."""
WIDE_OPENING = (1.4, 2.2)
"""Width of openings without a door, between kitchen and living room (m)."""
GRAIN = 0.05
"""Walls stand on multiples of this (m)."""
BATHROOM = (3.0, 10.5)
"""A bathroom's area (m2)."""


@dataclass(frozen=True)
class Plan:
    """Rooms and the openings between them."""

    rooms: tuple[Room, ...]
    openings: tuple[Opening, ...]


def random_plan(rng: np.random.Generator) -> Plan:
    """A plan; all of its rooms can be reached."""
    kinds: tuple[Callable[[np.random.Generator], Plan], ...] = (
        straight_corridor_plan,
        straight_corridor_plan,
        bent_corridor_plan,
        room_to_room_plan,
    )
    plan = kinds[int(rng.integers(len(kinds)))](rng)
    return _turned(plan, rng)


def straight_corridor_plan(rng: np.random.Generator) -> Plan:
    """5-10 rooms: a corridor between two rows of rooms ends in a living room, L-shaped at times, to
    which the kitchen is open."""
    bottom, top = _draw(rng, BAND), _draw(rng, BAND)
    width = _draw(rng, CORRIDOR)
    height = _grain(bottom + width + top)
    end = _draw(rng, (6.6, 11.5))
    living_end = _grain(end + _draw(rng, (3.8, 4.8)))
    upper = _row(rng, 0.0, end, bottom + width, height)
    lower = _row(rng, 0.0, end, 0.0, bottom)
    living = [Box(end, 0.0, living_end, height)]
    is_l_shaped = len(lower) > 1 and rng.random() < 0.5
    if is_l_shaped:
        living.append(lower.pop())
    kitchen = upper.pop() if is_l_shaped or rng.random() < 0.5 else lower.pop()
    corridor = Room("corridor", "corridor", (Box(0.0, bottom, end, _grain(bottom + width)),))
    rooms = [Room("living room", "living room", tuple(living)), corridor]
    rooms.append(Room("kitchen", "kitchen", (kitchen,)))
    private = _with_uses([*upper, *lower], rng)
    openings = [
        Opening(("corridor", "living room"), _grain(width - 0.4), 0.5),
        Opening(("kitchen", "living room"), _draw(rng, WIDE_OPENING), rng.uniform(0.2, 0.8)),
    ]
    openings += [_door(room.name, "corridor", rng) for room in private]
    return Plan((*rooms, *private), tuple(openings))


def bent_corridor_plan(rng: np.random.Generator) -> Plan:
    """5-8 rooms around an L-shaped corridor."""
    bottom, top, width = _draw(rng, BAND), _draw(rng, (3.6, 4.8)), _draw(rng, CORRIDOR)
    bend = _draw(rng, (3.4, 6.4))
    right = _grain(bend + width)
    low, high = _grain(bottom + width), _grain(bottom + width + top)
    end = _grain(right + _draw(rng, (3.8, 5.0)))
    boxes = (Box(0.0, bottom, right, low), Box(bend, low, right, high))
    living = Room("living room", "living room", (Box(right, bottom, end, high),))
    kitchen = Room("kitchen", "kitchen", (Box(right, 0.0, end, bottom),))
    private = _with_uses(
        [*_row(rng, 0.0, bend, low, high), *_row(rng, 0.0, right, 0.0, bottom)], rng
    )
    openings = [
        Opening(("corridor", "living room"), _draw(rng, (0.9, 1.4)), rng.uniform(0.1, 0.9)),
        Opening(("kitchen", "living room"), _draw(rng, WIDE_OPENING), rng.uniform(0.1, 0.9)),
    ]
    openings += [_door(room.name, "corridor", rng) for room in private]
    return Plan((living, Room("corridor", "corridor", boxes), kitchen, *private), tuple(openings))


def room_to_room_plan(rng: np.random.Generator) -> Plan:
    """4-6 rooms that open into each other, the largest one L-shaped at times."""
    whole = Box(0.0, 0.0, _draw(rng, (8.8, 11.8)), _draw(rng, (7.4, 10.0)))
    count = int(rng.integers(4, 7))
    leaves = [whole]
    while len(leaves) < count:
        leaves.sort(key=lambda box: -box.area)
        halves = next((h for h in (_halved(box, rng) for box in leaves) if h), None)
        if halves is None:
            break
        leaves = [box for box in leaves if not halves[0].overlaps(box)] + list(halves)
    leaves.sort(key=lambda box: -box.area)
    groups: list[tuple[Box, ...]] = [(box,) for box in leaves]
    if len(leaves) > 4 and rng.random() < 0.6:
        groups = _with_l_shape(groups)
    rooms = [Room("living room", "living room", groups[0])]
    others = _with_uses([boxes[0] for boxes in groups[1:]], rng)
    return _linked([*rooms, *others], rng)


def _linked(rooms: list[Room], rng: np.random.Generator) -> Plan:
    """Doors along a tree that starts in the living room; its smallest neighbour is the kitchen."""
    longest: dict[tuple[str, str], float] = {}
    for border in inner_borders(rooms):
        first, second = border.rooms
        if second is not None and border.length >= DOOR[1] + 0.5:
            longest[first, second] = max(longest.get((first, second), 0.0), border.length)
    area = {room.name: room.area for room in rooms}
    beside = sorted(
        (
            name
            for pair in longest
            if rooms[0].name in pair
            for name in pair
            if name != rooms[0].name
        ),
        key=lambda name: area[name],
    )
    kitchen = next((n for n in beside if area[n] > 7.0 and longest[rooms[0].name, n] > 2.8), None)
    reached, openings = {rooms[0].name}, []
    while len(reached) < len(rooms):
        ways = [pair for pair in longest if (pair[0] in reached) != (pair[1] in reached)]
        # from the living room wherever possible, else from the room reached first
        way = max(ways, key=lambda pair: (rooms[0].name in pair, longest[pair]))
        reached |= set(way)
        if kitchen in way and rooms[0].name in way:
            widest = min(WIDE_OPENING[1], longest[way] - 0.5)
            width = _draw(rng, (WIDE_OPENING[0], widest))
            openings.append(Opening(way, width, rng.uniform(0.2, 0.8)))
        else:
            openings.append(_door(*way, rng))
    renamed = {kitchen: "kitchen"} if kitchen else {}
    return Plan(
        tuple(
            replace(room, name="kitchen", kind="kitchen") if room.name in renamed else room
            for room in rooms
        ),
        tuple(
            replace(
                o, rooms=(renamed.get(o.rooms[0], o.rooms[0]), renamed.get(o.rooms[1], o.rooms[1]))
            )
            for o in openings
        ),
    )


def _with_l_shape(groups: list[tuple[Box, ...]]) -> list[tuple[Box, ...]]:
    """The first room joined with a neighbour whose shared side is wholly its own, if there is one."""
    first = groups[0][0]
    for other in groups[1:]:
        rooms = [Room("a", "", (first,)), Room("b", "", other)]
        for border in inner_borders(rooms):
            side = other[0].height if border.vertical else other[0].width
            own = first.height if border.vertical else first.width
            if abs(side - border.length) < GRAIN / 2 and border.length < 0.75 * own:
                return [(first, other[0]), *(g for g in groups[1:] if g is not other)]
    return groups


def _halved(box: Box, rng: np.random.Generator) -> tuple[Box, Box] | None:
    """A box cut across its longer side into two rooms, or None when it is too small for that."""
    share = rng.uniform(0.38, 0.62)
    if max(box.width, box.height) < 2 * SMALLEST_SIDE + 0.2:
        return None
    if box.width >= box.height:
        low, high = box.x0 + SMALLEST_SIDE, box.x1 - SMALLEST_SIDE
        x = _grain(min(max(box.x0 + share * box.width, low), high))
        return Box(box.x0, box.y0, x, box.y1), Box(x, box.y0, box.x1, box.y1)
    low, high = box.y0 + SMALLEST_SIDE, box.y1 - SMALLEST_SIDE
    y = _grain(min(max(box.y0 + share * box.height, low), high))
    return Box(box.x0, box.y0, box.x1, y), Box(box.x0, y, box.x1, box.y1)


def _row(rng: np.random.Generator, x0: float, x1: float, y0: float, y1: float) -> list[Box]:
    """A row of rooms of random widths."""
    length = x1 - x0
    most = int(length / (NARROWEST_ROOM + 0.4))
    count = int(rng.integers(max(1, most - 1), most + 1)) if most > 2 else max(1, most)
    spare = length - count * NARROWEST_ROOM
    shares = rng.dirichlet(np.full(count, 2.5))
    ends = x0 + np.cumsum(NARROWEST_ROOM + spare * shares)
    cuts = [x0, *(_grain(v) for v in ends[:-1]), x1]
    return [Box(a, _grain(y0), b, _grain(y1)) for a, b in pairwise(cuts)]


def _with_uses(boxes: list[Box], rng: np.random.Generator) -> list[Room]:
    """Bedrooms, a bathroom, a study: a use and a name for each box."""
    uses = ["bedroom"] * len(boxes)
    by_area = sorted(range(len(boxes)), key=lambda i: boxes[i].area)
    small = [i for i in by_area if BATHROOM[0] <= boxes[i].area <= BATHROOM[1]]
    for i in small[: 2 if len(boxes) > 5 else 1]:
        uses[i] = "bathroom"
    rest = [i for i in by_area if uses[i] == "bedroom"]
    if len(rest) > 1:
        uses[rest[int(rng.integers(len(rest) - 1))]] = "study"
    count: dict[str, int] = {}
    rooms = []
    for box, use in zip(boxes, uses, strict=True):
        count[use] = count.get(use, 0) + 1
        name = use if count[use] == 1 else f"{use} {count[use]}"
        rooms.append(Room(name, use, (box,)))
    return rooms


def _door(first: str, second: str, rng: np.random.Generator) -> Opening:
    return Opening((first, second), _draw(rng, DOOR), rng.uniform(0.05, 0.95))


def _draw(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    return _grain(rng.uniform(*bounds))


def _grain(value: float) -> float:
    return float(round(round(value / GRAIN) * GRAIN, 2))


def _turned(plan: Plan, rng: np.random.Generator) -> Plan:
    """The plan mirrored and transposed at random."""
    flip_x, flip_y, swap = rng.random(3) < 0.5
    boxes = [box for room in plan.rooms for box in room.boxes]
    right, top = max(b.x1 for b in boxes), max(b.y1 for b in boxes)

    def turned(b: Box) -> Box:
        x0, x1 = (right - b.x1, right - b.x0) if flip_x else (b.x0, b.x1)
        y0, y1 = (top - b.y1, top - b.y0) if flip_y else (b.y0, b.y1)
        x0, y0, x1, y1 = (round(v, 2) for v in (x0, y0, x1, y1))
        return Box(y0, x0, y1, x1) if swap else Box(x0, y0, x1, y1)

    rooms = tuple(replace(r, boxes=tuple(turned(b) for b in r.boxes)) for r in plan.rooms)
    return replace(plan, rooms=rooms)
