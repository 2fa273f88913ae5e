"""Finding a place for furniture: along walls, beside other pieces, in the middle of a room.

A place is good when the piece overlaps nothing, keeps doorways clear, leaves either no gap or one wide
enough for a person (and the robot) to everything around it, and cuts no floor off.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray
from core.mapping.occupancy_grid import DEFAULT_RESOLUTION, GridGeometry
from core.simulation.floor_plan import TOUCH, Box, Room, inner_borders, outer_borders
from core.simulation.furniture import Piece
from core.simulation.home import INNER_WALL, OUTER_WALL, WIDEST_DOOR, Home
from core.simulation.home_truth import cells_in

PASSAGE = 0.75
"""Gaps are at least this wide, or closed (m)."""
DOORWAY_DEPTH = 0.8
"""Clear floor before and behind a door (m)."""
DOORWAY_SIDE = 0.05
"""Clear floor beside a door's jambs (m)."""
STAND = 0.32
"""The room must stay passable for a disc of this radius (m)."""
ACROSS = 0.02
"""How far (m) one looks across a wall's axis to see on which side the room lies."""
CUT_OFF = 0.03
"""Largest share of a room's passable floor that a piece may cut off."""


@dataclass(frozen=True)
class WallSide:
    """A stretch of wall as seen from one room: where its face is and which way the room lies.

    `inwards`: +1 when the room lies towards larger coordinates.
    """

    vertical: bool
    face: float
    start: float
    stop: float
    inwards: int

    def box(self, low: float, high: float, depth: float) -> Box:
        """The box that stands at this wall from `low` to `high`, `depth` deep."""
        near, far = self.face, self.face + self.inwards * depth
        a, b = min(near, far), max(near, far)
        return Box(a, low, b, high) if self.vertical else Box(low, a, high, b)


class RoomLayout:
    """One room while it is being furnished."""

    def __init__(self, home: Home, room: Room) -> None:
        self.room = room
        self.pieces: list[Piece] = []
        self.walls = _wall_sides(home, room)
        self._doorways = [
            _doorway(door.gap, door.passed_along_x)
            for door in home.doors
            if room.name in door.rooms
        ]
        self._solid = [w for w in home.walls if any(w.overlaps(b.grown(0.01)) for b in room.boxes)]
        bounds = np.array([(b.x0, b.y0) for b in room.boxes] + [(b.x1, b.y1) for b in room.boxes])
        self._geometry = GridGeometry.around(bounds, 1.0, DEFAULT_RESOLUTION)
        self._floor = self._open_floor()

    @property
    def taken(self) -> list[Box]:
        """The footprints in the room so far."""
        return [piece.footprint for piece in self.pieces]

    def strips(self, wall: WallSide, depth: float) -> list[tuple[float, float, bool, bool]]:
        """Free stretches `(low, high, closed at low, closed at high)` along a wall, `depth` deep.

        A closed end is a wall or a piece that one can push furniture against; a doorway is no such.
        """
        strip = wall.box(wall.start, wall.stop, depth)
        ends = [(wall.start, wall.start, False), (wall.stop, wall.stop, False)]
        closed = [(box, True) for box in (*self._solid, *self.taken)]
        for box, solid in [*closed, *((box, False) for box in self._doorways)]:
            if box.overlaps(strip):
                low, high = (box.y0, box.y1) if wall.vertical else (box.x0, box.x1)
                ends.append((low, high, solid))
        ends.sort()
        found = []
        at, solid_before = ends[0][1], ends[0][2]
        for low, high, solid in ends[1:]:
            if low > at + TOUCH:
                found.append((at, low, solid_before, solid))
            if high > at + TOUCH:
                at, solid_before = high, solid
            elif abs(high - at) < TOUCH:
                solid_before = solid_before or solid
        return found

    def fits(self, box: Box, companions: Sequence[Box] = ()) -> bool:
        """Whether `box` is a good place; the gap to `companions` may be narrow."""
        inside = any(part.contains(box) for part in self.room.boxes)
        if not inside or any(box.overlaps(other) for other in (*self.taken, *self._solid)):
            return False
        if any(box.overlaps(doorway) for doorway in self._doorways):
            return False
        others = [b for b in (*self.taken, *self._solid) if b not in companions]
        if any(TOUCH < gap_between(box, other) < PASSAGE for other in others):
            return False
        return self._stays_passable(box)

    def add(self, piece: Piece) -> None:
        """Puts a piece where it was found to fit."""
        self.pieces.append(piece)
        self._floor[cells_in(piece.footprint, self._geometry)] = False

    def widest_gap(self, box: Box) -> float:
        """Distance (m) from `box` to the nearest thing in the room."""
        return min(gap_between(box, other) for other in (*self.taken, *self._solid))

    def _open_floor(self) -> BoolArray:
        floor = np.zeros(self._geometry.shape, np.bool_)
        for box in self.room.boxes:
            floor[cells_in(box, self._geometry)] = True
        for wall in self._solid:
            floor[cells_in(wall, self._geometry)] = False
        for doorway in self._doorways:
            floor[cells_in(doorway, self._geometry)] = True
        return floor

    def _stays_passable(self, box: Box) -> bool:
        floor = self._floor.copy()
        floor[cells_in(box, self._geometry)] = False
        distance = ndimage.distance_transform_edt(floor) * DEFAULT_RESOLUTION
        passable = distance >= STAND
        labels, count = ndimage.label(passable)
        if count == 0:
            return False
        sizes = np.bincount(labels.ravel())[1:]
        if sizes.max() < (1.0 - CUT_OFF) * sizes.sum():
            return False
        main = labels == sizes.argmax() + 1
        return all(main[cells_in(doorway, self._geometry)].any() for doorway in self._doorways)


def gap_between(a: Box, b: Box) -> float:
    """Distance (m) between two boxes, 0 where they touch or overlap."""
    dx = max(b.x0 - a.x1, a.x0 - b.x1, 0.0)
    dy = max(b.y0 - a.y1, a.y0 - b.y1, 0.0)
    return float(np.hypot(dx, dy))


def _doorway(gap: Box, passed_along_x: bool) -> Box:
    """The floor that a door needs on both sides; before a wide opening a little less."""
    wide = max(gap.width, gap.height) > WIDEST_DOOR
    depth = DOORWAY_DEPTH * (0.8 if wide else 1.0)
    if passed_along_x:
        return Box(gap.x0 - depth, gap.y0 - DOORWAY_SIDE, gap.x1 + depth, gap.y1 + DOORWAY_SIDE)
    return Box(gap.x0 - DOORWAY_SIDE, gap.y0 - depth, gap.x1 + DOORWAY_SIDE, gap.y1 + depth)


def _wall_sides(home: Home, room: Room) -> list[WallSide]:
    """All stretches of wall around a room."""
    inner = [(b, INNER_WALL) for b in inner_borders(home.rooms) if room.name in b.rooms]
    outer = [(b, OUTER_WALL) for b in outer_borders(home.rooms) if room.name in b.rooms]
    sides = []
    for border, thickness in (*inner, *outer):
        middle = (border.start + border.stop) / 2
        step = ACROSS
        ahead = (border.at + step, middle) if border.vertical else (middle, border.at + step)
        inwards = 1 if any(_has(box, *ahead) for box in room.boxes) else -1
        face = border.at + inwards * thickness / 2
        sides.append(WallSide(border.vertical, face, border.start, border.stop, inwards))
    return sides


def _has(box: Box, x: float, y: float) -> bool:
    return box.x0 <= x < box.x1 and box.y0 <= y < box.y1
