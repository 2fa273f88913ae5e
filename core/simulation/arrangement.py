"""Ways to arrange furniture in a room: backs to the wall, a table with chairs, a sofa with its table."""

from __future__ import annotations

import numpy as np

from core.simulation.floor_plan import Box, Room
from core.simulation.furniture import Piece, piece
from core.simulation.placement import PASSAGE, RoomLayout, WallSide, gap_between

Range = tuple[float, float]

TRIES = 40
"""Random places looked at for a piece in the middle of a room."""
TWO_CHAIRS = 0.5
"""Share of tables with two chairs pulled out rather than one; the others are under the table."""
CHAIR = 0.45
"""Side of a chair (m)."""
STRETCHABLE = {"bookshelf", "counter", "sideboard", "wardrobe"}
"""Pieces that are built to fill a gap that would otherwise be too narrow to use."""


def at_wall(
    layout: RoomLayout,
    rng: np.random.Generator,
    kind: str,
    along: Range,
    depth: Range,
    shorter: Range | None = None,
    near: Piece | None = None,
) -> tuple[Piece | None, WallSide | None]:
    """Puts a piece with its back to a wall, into a corner or against another piece if it can.

    `shorter` is tried when nothing fits; with `near` the place nearest to that piece is taken.
    """
    for size in (along, shorter) if shorter else (along,):
        assert size is not None
        length, deep = _cm(rng.uniform(*size)), _cm(rng.uniform(*depth))
        places = [
            (box, wall)
            for wall in layout.walls
            for box in _along(layout, rng, wall, kind, length, deep)
        ]
        order = [places[i] for i in rng.permutation(len(places))]
        if near is not None:
            order.sort(key=lambda place: gap_between(place[0], near.footprint))
        for box, wall in order:
            if layout.fits(box):
                placed = piece(kind, box)
                layout.add(placed)
                return placed, wall
    return None, None


def _along(
    layout: RoomLayout,
    rng: np.random.Generator,
    wall: WallSide,
    kind: str,
    length: float,
    depth: float,
) -> list[Box]:
    """Places along one wall: at both ends of each free stretch, and one anywhere in it."""
    found = []
    for low, high, closed_low, closed_high in layout.strips(wall, depth):
        slack = high - low - length
        if slack < 0:
            continue
        if slack < PASSAGE and closed_low and closed_high:
            if kind in STRETCHABLE:
                found.append(wall.box(low, high, depth))
            continue
        starts = [low, high - length]
        if slack > 2 * PASSAGE or not (closed_low or closed_high):
            starts.append(low + rng.uniform(0.0, slack))
        found += [wall.box(start, start + length, depth) for start in starts]
    return found


def beside(
    layout: RoomLayout,
    rng: np.random.Generator,
    kind: str,
    along: float,
    depth: float,
    other: Piece,
    wall: WallSide,
) -> None:
    """Puts a piece at the same wall, touching another one."""
    box = other.footprint
    low, high = (box.y0, box.y1) if wall.vertical else (box.x0, box.x1)
    sides = [(low - along, low), (high, high + along)]
    for i in rng.permutation(2):
        place = wall.box(*sides[int(i)], depth)
        if layout.fits(place):
            layout.add(piece(kind, place))
            if rng.random() < 0.5:
                return


def in_the_middle(
    layout: RoomLayout, rng: np.random.Generator, kind: str, width: float, height: float
) -> Piece | None:
    """Puts a piece where a room is emptiest, away from the walls."""
    width, height = _cm(width), _cm(height)
    places = [_random_box(layout.room, rng, width, height) for _ in range(TRIES)]
    places.sort(key=lambda box: -min(layout.widest_gap(box), 1.3))
    for box in places[: TRIES // 4]:
        if layout.widest_gap(box) >= PASSAGE and layout.fits(box):
            placed = piece(kind, box)
            layout.add(placed)
            return placed
    return None


def before_sofa(layout: RoomLayout, rng: np.random.Generator, sofa: Piece) -> None:
    """A coffee table in front of a sofa, on the side where there is more room."""
    box = sofa.footprint
    wide = box.width > box.height
    x, y = box.centre
    long, short = rng.uniform(0.9, 1.2), rng.uniform(0.5, 0.65)
    gap = PASSAGE + 0.02
    places = []
    for side in (-1, 1):
        if wide:
            middle = (box.y1 if side > 0 else box.y0) + side * (gap + short / 2)
            places.append(_around(x, middle, long, short))
        else:
            middle = (box.x1 if side > 0 else box.x0) + side * (gap + short / 2)
            places.append(_around(middle, y, short, long))
    places.sort(key=lambda place: -layout.widest_gap(place))
    for place in places:
        if layout.fits(place):
            layout.add(piece("coffee table", place))
            return


def dining(layout: RoomLayout, rng: np.random.Generator) -> None:
    """A table in the middle with chairs at its long sides, or a small round one."""
    long, short = rng.uniform(1.2, 1.6), rng.uniform(0.8, 0.9)
    reach = CHAIR + 0.1
    for wide in rng.permutation(2) == 0:
        size = (long, short + 2 * reach) if wide else (short + 2 * reach, long)
        places = [_random_box(layout.room, rng, *size) for _ in range(TRIES)]
        places.sort(key=lambda box: -min(layout.widest_gap(box), 1.3))
        for box in places[: TRIES // 4]:
            if layout.widest_gap(box) >= PASSAGE and layout.fits(box):
                _set_table(layout, rng, box, bool(wide), reach)
                return
    placed = in_the_middle(layout, rng, "round table", 0.8, 0.8)
    if placed is None and layout.room.kind == "kitchen":
        at_wall(layout, rng, "round table", (0.7, 0.75), (0.7, 0.75))


def _set_table(
    layout: RoomLayout, rng: np.random.Generator, place: Box, wide: bool, reach: float
) -> None:
    """The table inside `place`, and the chairs that are not pushed under it."""
    table = (
        Box(place.x0, place.y0 + reach, place.x1, place.y1 - reach)
        if wide
        else Box(place.x0 + reach, place.y0, place.x1 - reach, place.y1)
    )
    layout.add(piece("dining table", table))
    low, high = (place.x0, place.x1) if wide else (place.y0, place.y1)
    seats = (low + 0.27 * (high - low), low + 0.73 * (high - low))
    pulled_out = [(side, seat) for side in (0, 1) for seat in seats]
    count = 1 + int(rng.random() < TWO_CHAIRS)
    for choice in rng.permutation(len(pulled_out))[:count]:
        side, seat = pulled_out[int(choice)]
        pulled = rng.uniform(0.0, 0.1)
        start = _cm(seat - CHAIR / 2)
        if wide:
            y = place.y0 + pulled if side == 0 else place.y1 - CHAIR - pulled
            chair = Box(start, _cm(y), start + CHAIR, _cm(y) + CHAIR)
        else:
            x = place.x0 + pulled if side == 0 else place.x1 - CHAIR - pulled
            chair = Box(_cm(x), start, _cm(x) + CHAIR, start + CHAIR)
        layout.add(piece("chair", chair))


def desk(layout: RoomLayout, rng: np.random.Generator) -> None:
    """A desk at a wall and a chair before it."""
    desk, wall = at_wall(layout, rng, "desk", (1.1, 1.5), (0.6, 0.75))
    if desk is None or wall is None:
        return
    box = desk.footprint
    low, high = (box.y0, box.y1) if wall.vertical else (box.x0, box.x1)
    start = _cm((low + high - CHAIR) / 2 + rng.uniform(-0.15, 0.15))
    depth = box.width if wall.vertical else box.height
    out = depth + rng.uniform(0.05, 0.15)
    front = WallSide(wall.vertical, wall.face + wall.inwards * out, low, high, wall.inwards)
    place = front.box(start, start + CHAIR, CHAIR)
    if layout.fits(place, companions=[box]):
        layout.add(piece("chair", place))


def _random_box(room: Room, rng: np.random.Generator, width: float, height: float) -> Box:
    areas = np.array([box.area for box in room.boxes])
    part = room.boxes[int(rng.choice(len(areas), p=areas / areas.sum()))]
    x = rng.uniform(part.x0, max(part.x1 - width, part.x0))
    y = rng.uniform(part.y0, max(part.y1 - height, part.y0))
    return Box(_cm(x), _cm(y), _cm(x + width), _cm(y + height))


def _around(x: float, y: float, width: float, height: float) -> Box:
    return Box(_cm(x - width / 2), _cm(y - height / 2), _cm(x + width / 2), _cm(y + height / 2))


def _cm(value: float) -> float:
    """Rounded to a centimetre."""
    return float(round(value, 2))
