"""A furnished home, and what can change in it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

from core.errors import InputError
from core.simulation.floor_plan import (
    Border,
    Box,
    Door,
    Opening,
    Room,
    cut_out,
    inner_borders,
    outer_borders,
)
from core.simulation.furniture import Piece

INNER_WALL = 0.10
"""Thickness of a wall between rooms (m)."""
OUTER_WALL = 0.20
"""Thickness of the walls to the outside (m); half of it lies outside the plan."""
JAMB = 0.15
"""A door keeps at least this far from the end of its wall's axis (m)."""
Thing = TypeVar("Thing", Piece, Door, Room)

WIDEST_DOOR = 1.05
"""Wider openings have no door leaf that could be shut (m)."""


@dataclass(frozen=True)
class Home:
    """Rooms, doors and furniture in the home's frame (metres, x right, y up).

    Attributes:
        name: as on the command line.
        rooms: they tile the plan.
        doors: open gaps in walls, wide openings too.
        furniture: pieces with unique names.
        shut: names of the doors that are shut.
    """

    name: str
    rooms: tuple[Room, ...]
    doors: tuple[Door, ...]
    furniture: tuple[Piece, ...] = ()
    shut: frozenset[str] = frozenset()

    @cached_property
    def bounds(self) -> Box:
        """The smallest box around everything, outer walls included."""
        boxes = [box for room in self.rooms for box in room.boxes]
        plan = Box(
            min(b.x0 for b in boxes),
            min(b.y0 for b in boxes),
            max(b.x1 for b in boxes),
            max(b.y1 for b in boxes),
        )
        return plan.grown(OUTER_WALL / 2)

    @cached_property
    def walls(self) -> tuple[Box, ...]:
        """All walls as boxes, without the gaps of open doors, with the leaves of shut ones."""
        walls = [border.wall(OUTER_WALL) for border in outer_borders(self.rooms)]
        inner = [border.wall(INNER_WALL) for border in inner_borders(self.rooms)]
        for door in self.doors:
            if door.name not in self.shut:
                inner = [part for wall in inner for part in cut_out(wall, door.gap)]
        return tuple(walls + inner)

    def without(self, name: str) -> Home:
        """The home after a piece of furniture was carried out."""
        gone = self.piece(name)
        return replace(self, furniture=tuple(p for p in self.furniture if p is not gone))

    def with_moved(self, name: str, dx: float, dy: float) -> Home:
        """The home after a piece of furniture was pushed by `(dx, dy)` metres."""
        moved = self.piece(name)
        return replace(
            self,
            furniture=tuple(p.moved(dx, dy) if p is moved else p for p in self.furniture),
        )

    def with_shut(self, door: str) -> Home:
        """The home with one door shut."""
        return replace(self, shut=self.shut | {self.door(door).name})

    def with_open(self, door: str) -> Home:
        """The home with one door open."""
        return replace(self, shut=self.shut - {self.door(door).name})

    def piece(self, name: str) -> Piece:
        """The piece of furniture of that name."""
        return _named(self.furniture, name, "piece of furniture", self.name)

    def door(self, name: str) -> Door:
        """The door of that name."""
        return _named(self.doors, name, "door", self.name)

    def room(self, name: str) -> Room:
        """The room of that name."""
        return _named(self.rooms, name, "room", self.name)


def _named(things: tuple[Thing, ...], name: str, what: str, home: str) -> Thing:
    for thing in things:
        if thing.name == name:
            return thing
    there_are = ", ".join(thing.name for thing in things) or "none"
    raise InputError(f"home {home!r} has no {what} {name!r}; it has: {there_are}")


def make_doors(rooms: Iterable[Room], openings: Iterable[Opening]) -> tuple[Door, ...]:
    """Doors in the longest wall that the two rooms of each opening share.

    Raises:
        InputError: two rooms do not share a wall that is long enough.
    """
    borders = inner_borders(tuple(rooms))
    doors = []
    for number, opening in enumerate(openings, 1):
        border = _longest(borders, opening)
        slack = border.length - opening.width - 2 * JAMB
        centre = border.start + JAMB + opening.width / 2 + opening.along * slack
        gap = border.gap(round(centre, 2), opening.width, INNER_WALL)
        doors.append(Door(f"door {number}", opening.rooms, gap))
    return tuple(doors)


def _longest(borders: list[Border], opening: Opening) -> Border:
    shared = [b for b in borders if set(b.rooms) == set(opening.rooms)]
    if not shared or max(b.length for b in shared) < opening.width + 2 * JAMB:
        first, second = opening.rooms
        raise InputError(
            f"{first!r} and {second!r} share no wall for an opening of {opening.width} m"
        )
    return max(shared, key=lambda b: b.length)
