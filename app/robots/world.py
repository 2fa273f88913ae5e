"""What a person may do to a simulated home while the robot is in it."""

from __future__ import annotations

from typing import Any

import numpy as np

from core.errors import InputError
from core.geometry import FloatArray
from core.simulation.floor_plan import Box
from core.simulation.home import WIDEST_DOOR, Home

SKIRTING = 0.02
"""Furniture keeps this far from walls (m)."""
NUDGE, NUDGE_STEP = 0.6, 0.05
"""How far from where it was wanted a piece may end up, and how finely that is tried (m)."""


def with_door(home: Home, name: str, shut: bool, robot: FloatArray, radius: float) -> Home:
    """The home with a door shut or open.

    Raises:
        InputError: there is no such door, it has no leaf, or the robot stands in it.
    """
    door = home.door(name)
    if not shut:
        return home.with_open(name)
    if door.width > WIDEST_DOOR:
        raise InputError(f"{name} is an opening without a door: it cannot be shut")
    if _covers(door.gap, robot, radius):
        raise InputError(f"the robot stands in {name}: drive on before it is shut")
    return home.with_shut(name)


def with_furniture_at(
    home: Home, name: str, place: tuple[float, float], robot: FloatArray, radius: float
) -> Home:
    """The home with a piece's middle at a place, or as near to it as there is room.

    Raises:
        InputError: there is no such piece, or no room within NUDGE metres.
    """
    piece = home.piece(name)
    x, y = piece.footprint.centre
    taken = [wall.grown(SKIRTING) for wall in home.walls]
    taken += [other.footprint for other in home.furniture if other is not piece]
    for nudge_x, nudge_y in _nudges():
        dx, dy = place[0] + nudge_x - x, place[1] + nudge_y - y
        there = piece.footprint.moved(dx, dy)
        if (
            _indoors(home, there)
            and not any(there.overlaps(box) for box in taken)
            and not _covers(there, robot, radius)
        ):
            return home.with_moved(name, dx, dy)
    raise InputError(f"there is no room for the {name} at ({place[0]:.2f}, {place[1]:.2f})")


def described(home: Home) -> dict[str, list[dict[str, Any]]]:
    """Doors that can be shut, and furniture: names, places (m) and states."""
    doors = [
        {
            "name": door.name,
            "rooms": list(door.rooms),
            "shut": door.name in home.shut,
            "position": _rounded(door.gap.centre),
        }
        for door in home.doors
        if door.width <= WIDEST_DOOR
    ]
    furniture = [
        {
            "name": piece.name,
            "position": _rounded(piece.footprint.centre),
            "size": _rounded((piece.footprint.width, piece.footprint.height)),
        }
        for piece in home.furniture
    ]
    return {"doors": doors, "furniture": furniture}


def _nudges() -> FloatArray:
    """Offsets (K, 2) on a lattice, the shortest first."""
    along = np.arange(-NUDGE, NUDGE + NUDGE_STEP / 2, NUDGE_STEP)
    offsets = np.stack(np.meshgrid(along, along), axis=-1).reshape(-1, 2)
    return np.asarray(offsets[np.argsort(np.hypot(*offsets.T), kind="stable")])


def _indoors(home: Home, box: Box) -> bool:
    """Whether the middle of a box is in a room; walls keep the rest of it there."""
    x, y = box.centre
    return any(
        part.x0 <= x < part.x1 and part.y0 <= y < part.y1
        for room in home.rooms
        for part in room.boxes
    )


def _covers(box: Box, robot: FloatArray, radius: float) -> bool:
    around = box.grown(radius)
    x, y = float(robot[0]), float(robot[1])
    return around.x0 <= x < around.x1 and around.y0 <= y < around.y1


def _rounded(pair: tuple[float, float]) -> list[float]:
    return [round(value, 2) for value in pair]
