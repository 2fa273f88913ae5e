"""Worlds that put one difficulty on its own: look-alike rooms, a featureless corridor, an empty hall."""

from __future__ import annotations

from core.simulation.floor_plan import Box, Opening, Room
from core.simulation.furniture import Piece, numbered, piece
from core.simulation.home import Home, make_doors

MIRRORED_SIDE = 4.2
"""Side of each of the four rooms of the mirrored home (m)."""
CORRIDOR = Box(0.0, 0.0, 24.0, 2.0)
"""The long plain corridor."""
HALL = Box(0.0, 0.0, 14.0, 11.0)
"""The hall; its middle is out of every wall's reach."""
NICHE = 0.35
"""Depth of the door niches of the office corridor (m)."""


def mirrored_home() -> Home:
    """Four equal rooms, each the mirror image of its neighbours: the home looks the same from all of them."""
    side = MIRRORED_SIDE
    corners = {
        "south west": (0, 0),
        "south east": (1, 0),
        "north west": (0, 1),
        "north east": (1, 1),
    }
    rooms = tuple(
        Room(name, "room", (Box(i * side, j * side, (i + 1) * side, (j + 1) * side),))
        for name, (i, j) in corners.items()
    )
    openings = [
        Opening(("south west", "south east"), 0.9),
        Opening(("north west", "north east"), 0.9),
        Opening(("south west", "north west"), 0.9),
        Opening(("south east", "north east"), 0.9),
    ]
    one = (
        ("wardrobe", Box(0.1, 0.1, 0.7, 0.7)),
        ("sideboard", Box(1.5, 0.1, 2.7, 0.55)),
        ("sideboard", Box(0.1, 1.5, 0.55, 2.7)),
        ("coffee table", Box(1.75, 1.75, 2.45, 2.45)),
    )
    pieces: list[Piece] = []
    for i, j in corners.values():
        pieces += [piece(kind, _mirrored(box, 2 * side, bool(i), bool(j))) for kind, box in one]
    return Home("mirrored", rooms, make_doors(rooms, openings), numbered(pieces))


def corridor_home() -> Home:
    """One long plain corridor."""
    return Home("corridor", (Room("corridor", "corridor", (CORRIDOR,)),), ())


def hall_home() -> Home:
    """One large empty hall."""
    return Home("hall", (Room("hall", "hall", (HALL,)),), ())


def office_home() -> Home:
    """An L-shaped office corridor with door niches, a junction and some clutter along its walls."""
    corridor = Room("corridor", "corridor", (Box(0.0, 0.0, 16.0, 1.9), Box(14.0, 1.9, 16.0, 12.0)))
    side = Room("side corridor", "corridor", (Box(7.0, 1.9, 8.8, 7.0),))
    niches = [Box(x, -NICHE, x + 1.0, 0.0) for x in (1.2, 4.4, 7.6, 10.8)]
    niches += [Box(16.0, y, 16.0 + NICHE, y + 1.0) for y in (2.6, 5.6, 8.6)]
    rooms = (Room("corridor", "corridor", (*corridor.boxes, *niches)), side)
    openings = [Opening(("corridor", "side corridor"), 1.5)]
    furniture = [
        piece("bookshelf", Box(2.6, 1.45, 3.9, 1.8)),
        piece("bench", Box(9.6, 1.4, 10.8, 1.8)),
        piece("plant", Box(15.5, 11.5, 15.9, 11.9)),
        piece("chest", Box(14.1, 4.2, 14.5, 5.2)),
        piece("bookshelf", Box(14.1, 8.0, 14.4, 9.2)),
    ]
    return Home("office", rooms, make_doors(rooms, openings), numbered(furniture))


def _mirrored(box: Box, size: float, in_x: bool, in_y: bool) -> Box:
    x0, x1 = (size - box.x1, size - box.x0) if in_x else (box.x0, box.x1)
    y0, y1 = (size - box.y1, size - box.y0) if in_y else (box.y0, box.y1)
    return Box(round(x0, 3), round(y0, 3), round(x1, 3), round(y1, 3))
