"""Floor plans: rooms made of boxes, the walls between them, and the doors in those walls.

Rooms tile the plan: the boxes of two neighbours share a border, and the wall stands on that border.
All measures in metres in the home's frame, x right and y up.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

TOUCH = 1e-6
"""Coordinates closer than this are the same border (m)."""


@dataclass(frozen=True)
class Box:
    """An axis-parallel rectangle `[x0, x1) x [y0, y1)` in metres."""

    x0: float
    y0: float
    x1: float
    y1: float

    @property
    def width(self) -> float:
        """Extent along x, metres."""
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        """Extent along y, metres."""
        return self.y1 - self.y0

    @property
    def area(self) -> float:
        """Square metres."""
        return self.width * self.height

    @property
    def centre(self) -> tuple[float, float]:
        """The middle `(x, y)`."""
        return ((self.x0 + self.x1) / 2, (self.y0 + self.y1) / 2)

    def grown(self, margin: float) -> Box:
        """The box with `margin` metres more on every side."""
        return Box(self.x0 - margin, self.y0 - margin, self.x1 + margin, self.y1 + margin)

    def moved(self, dx: float, dy: float) -> Box:
        """The box shifted by `(dx, dy)` metres."""
        return Box(self.x0 + dx, self.y0 + dy, self.x1 + dx, self.y1 + dy)

    def overlaps(self, other: Box) -> bool:
        """Whether the two share an area (touching is not overlapping)."""
        return (
            self.x0 < other.x1 - TOUCH
            and other.x0 < self.x1 - TOUCH
            and self.y0 < other.y1 - TOUCH
            and other.y0 < self.y1 - TOUCH
        )

    def contains(self, other: Box) -> bool:
        """Whether `other` lies inside, borders included."""
        return (
            self.x0 - TOUCH <= other.x0
            and other.x1 <= self.x1 + TOUCH
            and self.y0 - TOUCH <= other.y0
            and other.y1 <= self.y1 + TOUCH
        )


@dataclass(frozen=True)
class Room:
    """A room: its name, what it is used for, and the one or more boxes that it is made of."""

    name: str
    kind: str
    boxes: tuple[Box, ...]

    @property
    def area(self) -> float:
        """Square metres from wall axis to wall axis."""
        return sum(box.area for box in self.boxes)


@dataclass(frozen=True)
class Opening:
    """A gap in the wall between two rooms, wished for in a plan: where its middle lies and how wide.

    `along` is the position of the middle along the shared border as a share 0..1.
    """

    rooms: tuple[str, str]
    width: float
    along: float = 0.5


@dataclass(frozen=True)
class Door:
    """An open gap in a wall: the two rooms it joins and the box of wall that it takes out."""

    name: str
    rooms: tuple[str, str]
    gap: Box

    @property
    def passed_along_x(self) -> bool:
        """Whether one walks through it in x (it is a gap in a vertical wall)."""
        return self.gap.width < self.gap.height

    @property
    def width(self) -> float:
        """Metres between the two jambs."""
        return max(self.gap.width, self.gap.height)


@dataclass(frozen=True)
class Border:
    """A straight stretch where two rooms (or a room and the outside, None) meet.

    `vertical`: lies at x = `at`, from y = `start` to `stop`; otherwise at y = `at` along x.
    """

    rooms: tuple[str, str | None]
    vertical: bool
    at: float
    start: float
    stop: float

    @property
    def length(self) -> float:
        """Metres."""
        return self.stop - self.start

    def wall(self, thickness: float) -> Box:
        """The wall that stands on this border, long enough to close its corners."""
        half = thickness / 2
        if self.vertical:
            return Box(self.at - half, self.start - half, self.at + half, self.stop + half)
        return Box(self.start - half, self.at - half, self.stop + half, self.at + half)

    def gap(self, centre: float, width: float, thickness: float) -> Box:
        """The box that a door of `width` with its middle at `centre` takes out of the wall."""
        half = thickness / 2
        low, high = centre - width / 2, centre + width / 2
        if self.vertical:
            return Box(self.at - half, low, self.at + half, high)
        return Box(low, self.at - half, high, self.at + half)


def inner_borders(rooms: Iterable[Room]) -> list[Border]:
    """All stretches where two different rooms touch, in the order of the rooms."""
    found = []
    for first, second in combinations(rooms, 2):
        for a in first.boxes:
            for b in second.boxes:
                found += _contact(first.name, second.name, a, b)
    return found


def outer_borders(rooms: Iterable[Room]) -> list[Border]:
    """All stretches where a room meets the outside."""
    boxes = [(room.name, box) for room in rooms for box in room.boxes]
    found = []
    for name, box in boxes:
        sides = (
            (True, box.x0, box.y0, box.y1, -1),
            (True, box.x1, box.y0, box.y1, 1),
            (False, box.y0, box.x0, box.x1, -1),
            (False, box.y1, box.x0, box.x1, 1),
        )
        for vertical, at, low, high, outwards in sides:
            covered = [
                _span(other, vertical)
                for _, other in boxes
                if other != box and abs(_near_side(other, vertical, outwards) - at) < TOUCH
            ]
            found += [
                Border((name, None), vertical, at, start, stop)
                for start, stop in _uncovered(low, high, covered)
            ]
    return found


def _contact(name_a: str, name_b: str, a: Box, b: Box) -> list[Border]:
    """The shared border of two boxes, if any."""
    found = []
    for vertical in (True, False):
        (a_low, a_high), (b_low, b_high) = _span(a, vertical), _span(b, vertical)
        start, stop = max(a_low, b_low), min(a_high, b_high)
        if stop - start <= TOUCH:
            continue
        for outwards in (-1, 1):
            at = _near_side(a, vertical, -outwards)
            if abs(at - _near_side(b, vertical, outwards)) < TOUCH:
                found.append(Border((name_a, name_b), vertical, at, start, stop))
    return found


def _span(box: Box, vertical: bool) -> tuple[float, float]:
    """Extent of the box along a border's direction."""
    return (box.y0, box.y1) if vertical else (box.x0, box.x1)


def _near_side(box: Box, vertical: bool, outwards: int) -> float:
    """The side of a box that faces somebody who looks `outwards` (+1: along the axis) at it."""
    if vertical:
        return box.x0 if outwards > 0 else box.x1
    return box.y0 if outwards > 0 else box.y1


def _uncovered(
    low: float, high: float, covered: list[tuple[float, float]]
) -> list[tuple[float, float]]:
    """The parts of `low`..`high` that no interval covers."""
    parts = []
    at = low
    for start, stop in sorted(covered):
        if start > at + TOUCH:
            parts.append((at, min(start, high)))
        at = max(at, stop)
        if at >= high - TOUCH:
            break
    if at < high - TOUCH:
        parts.append((at, high))
    return [(start, stop) for start, stop in parts if stop - start > TOUCH]


def cut_out(box: Box, hole: Box) -> list[Box]:
    """The up to four boxes that remain of `box` without `hole`."""
    if not box.overlaps(hole):
        return [box]
    low, high = max(box.y0, hole.y0), min(box.y1, hole.y1)
    parts = (
        Box(box.x0, box.y0, box.x1, low),
        Box(box.x0, high, box.x1, box.y1),
        Box(box.x0, low, hole.x0, high),
        Box(hole.x1, low, box.x1, high),
    )
    return [part for part in parts if part.width > TOUCH and part.height > TOUCH]
