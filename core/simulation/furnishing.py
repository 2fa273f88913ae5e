"""Furnishing a plan: every room gets what its use asks for, where it fits."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from core.simulation.arrangement import (
    at_wall,
    before_sofa,
    beside,
    desk,
    dining,
    in_the_middle,
)
from core.simulation.furniture import Piece, numbered
from core.simulation.home import Home
from core.simulation.placement import RoomLayout

FLOATING_SOFA = 0.45
"""Share of large living rooms whose sofa stands in the room, not at a wall."""


def furnished(home: Home, rng: np.random.Generator) -> Home:
    """The home with furniture in every room."""
    pieces: list[Piece] = []
    for room in home.rooms:
        layout = RoomLayout(home, room)
        FURNISH[room.kind](layout, rng)
        pieces += layout.pieces
    return Home(home.name, home.rooms, home.doors, numbered(pieces))


def _bedroom(layout: RoomLayout, rng: np.random.Generator) -> None:
    area = layout.room.area
    beds = [(1.6, 2.05), (1.4, 2.0), (0.95, 2.0)] if area > 11 else [(0.95, 2.0)]
    bed, wall = None, None
    for width, length in beds:
        bed, wall = at_wall(layout, rng, "bed", (width, width), (length, length))
        if bed is None:
            bed, wall = at_wall(layout, rng, "bed", (length, length), (width, width))
        if bed is not None:
            break
    if bed is not None and wall is not None:
        beside(layout, rng, "night stand", 0.4, 0.4, bed, wall)
    at_wall(layout, rng, "wardrobe", (1.2, 2.2), (0.6, 0.6), (0.9, 1.2))
    if rng.random() < 0.5:
        desk(layout, rng)
    if rng.random() < 0.6:
        at_wall(layout, rng, "chest", (0.8, 1.3), (0.45, 0.5))


def _living_room(layout: RoomLayout, rng: np.random.Generator) -> None:
    length, depth = rng.uniform(1.8, 2.3), rng.uniform(0.85, 0.95)
    sofa = None
    if layout.room.area > 20 and rng.random() < FLOATING_SOFA:
        along = (length, depth) if rng.random() < 0.5 else (depth, length)
        sofa = in_the_middle(layout, rng, "sofa", *along)
    if sofa is None:
        sofa, _ = at_wall(layout, rng, "sofa", (length, length), (depth, depth))
    if sofa is not None:
        before_sofa(layout, rng, sofa)
    at_wall(layout, rng, "tv bench", (1.3, 1.8), (0.4, 0.45))
    at_wall(layout, rng, "bookshelf", (0.9, 1.8), (0.33, 0.35))
    if layout.room.area > 18:
        dining(layout, rng)
    in_the_middle(layout, rng, "armchair", 0.7, 0.7)
    if layout.room.area > 22:
        at_wall(layout, rng, "sideboard", (1.0, 1.8), (0.45, 0.45))
    at_wall(layout, rng, "plant", (0.4, 0.4), (0.4, 0.4))


def _kitchen(layout: RoomLayout, rng: np.random.Generator) -> None:
    counter, _ = at_wall(layout, rng, "counter", (1.8, 3.2), (0.6, 0.6), (1.2, 1.8))
    at_wall(layout, rng, "fridge", (0.6, 0.65), (0.62, 0.65), near=counter)
    at_wall(layout, rng, "counter", (1.0, 2.0), (0.6, 0.6), near=counter)
    if layout.room.area > 9:
        dining(layout, rng)


def _bathroom(layout: RoomLayout, rng: np.random.Generator) -> None:
    at_wall(layout, rng, "bathtub", (1.6, 1.7), (0.72, 0.75))
    at_wall(layout, rng, "basin", (0.55, 0.8), (0.45, 0.5))
    at_wall(layout, rng, "toilet", (0.4, 0.4), (0.62, 0.66))
    at_wall(layout, rng, "washing machine", (0.6, 0.6), (0.6, 0.6))


def _study(layout: RoomLayout, rng: np.random.Generator) -> None:
    desk(layout, rng)
    at_wall(layout, rng, "bookshelf", (1.0, 2.2), (0.33, 0.38))
    if layout.room.area > 9:
        at_wall(layout, rng, "sofa", (1.5, 1.9), (0.8, 0.9))
    at_wall(layout, rng, "chest", (0.7, 1.2), (0.4, 0.45))
    at_wall(layout, rng, "plant", (0.35, 0.45), (0.35, 0.45))


def _corridor(layout: RoomLayout, rng: np.random.Generator) -> None:
    at_wall(layout, rng, "shoe rack", (0.7, 1.2), (0.3, 0.35))


FURNISH: dict[str, Callable[[RoomLayout, np.random.Generator], None]] = {
    "bathroom": _bathroom,
    "bedroom": _bedroom,
    "corridor": _corridor,
    "kitchen": _kitchen,
    "living room": _living_room,
    "study": _study,
}
"""How a room is furnished, by its use."""
