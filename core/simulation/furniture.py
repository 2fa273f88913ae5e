"""Pieces of furniture: what stands on the floor and how its surface sends sound back."""

from __future__ import annotations

from dataclasses import dataclass, replace

from core.simulation.floor_plan import Box

LEG = 0.05
"""Side of a chair's leg (m). A table counts as solid: its top lies inside the beam, which is as high as
it is wide."""


@dataclass(frozen=True)
class Disc:
    """A round solid: middle `(x, y)` and radius, metres."""

    x: float
    y: float
    radius: float

    def moved(self, dx: float, dy: float) -> Disc:
        """The disc shifted by `(dx, dy)` metres."""
        return replace(self, x=self.x + dx, y=self.y + dy)


@dataclass(frozen=True)
class Surface:
    """How a surface answers a sonar.

    Attributes:
        lobe: half width (rad) of the directions around the normal into which it still sends an echo
            by its small structure (mouldings, folds, handles); smooth plaster is a near mirror.
        reflectivity: share of the sound pressure that is kept at a reflection, 0..1.
        scatter: pressure sent straight back whatever the angle, relative to a mirror hit squarely.
    """

    lobe: float
    reflectivity: float
    scatter: float


SURFACES: dict[str, Surface] = {
    "plaster": Surface(lobe=0.16, reflectivity=0.95, scatter=0.010),
    "fittings": Surface(lobe=0.45, reflectivity=0.85, scatter=0.050),
    "wood": Surface(lobe=0.22, reflectivity=0.90, scatter=0.018),
    "shelf": Surface(lobe=0.55, reflectivity=0.75, scatter=0.060),
    "cloth": Surface(lobe=0.45, reflectivity=0.35, scatter=0.040),
    "leg": Surface(lobe=0.60, reflectivity=0.60, scatter=0.070),
}
"""Surfaces by name. `fittings`: stretches of wall with a radiator, skirting, frames, switches."""


@dataclass(frozen=True)
class Piece:
    """One piece of furniture.

    Attributes:
        name: unique in its home ("sofa", "chair 2").
        kind: "sofa", "chair", ...
        footprint: the floor it takes; the robot does not drive there, not even between legs.
        solids: what the sonar meets at its height (all of the footprint, or four legs).
        surface: key of SURFACES.
        height: metres, for drawing.
    """

    name: str
    kind: str
    footprint: Box
    solids: tuple[Box | Disc, ...]
    surface: str
    height: float

    def moved(self, dx: float, dy: float) -> Piece:
        """The same piece shifted by `(dx, dy)` metres."""
        return replace(
            self,
            footprint=self.footprint.moved(dx, dy),
            solids=tuple(solid.moved(dx, dy) for solid in self.solids),
        )


@dataclass(frozen=True)
class Kind:
    """What pieces of a kind are made of: surface, drawn height (m), on legs, round."""

    surface: str
    height: float
    on_legs: bool = False
    is_round: bool = False


KINDS: dict[str, Kind] = {
    "armchair": Kind("cloth", 0.8),
    "basin": Kind("wood", 0.85),
    "bathtub": Kind("wood", 0.55),
    "bed": Kind("cloth", 0.5),
    "bench": Kind("wood", 0.45),
    "bookshelf": Kind("shelf", 1.9),
    "chair": Kind("leg", 0.9, on_legs=True),
    "chest": Kind("wood", 0.9),
    "coffee table": Kind("wood", 0.45),
    "counter": Kind("shelf", 0.9),
    "desk": Kind("wood", 0.75),
    "dining table": Kind("wood", 0.75),
    "fridge": Kind("wood", 1.8),
    "night stand": Kind("wood", 0.5),
    "plant": Kind("shelf", 1.2, is_round=True),
    "round table": Kind("wood", 0.75, is_round=True),
    "shoe rack": Kind("shelf", 0.9),
    "sideboard": Kind("wood", 0.8),
    "sofa": Kind("cloth", 0.8),
    "stove": Kind("wood", 0.9),
    "toilet": Kind("wood", 0.8),
    "tv bench": Kind("wood", 0.5),
    "wardrobe": Kind("wood", 2.0),
    "washing machine": Kind("wood", 0.85),
}


def piece(kind: str, box: Box, name: str | None = None) -> Piece:
    """A piece of one of the KINDS that fills `box`."""
    made_of = KINDS[kind]
    solids: tuple[Box | Disc, ...] = (box,)
    if made_of.on_legs:
        solids = _legs(box)
    elif made_of.is_round:
        solids = (Disc(*box.centre, min(box.width, box.height) / 2),)
    return Piece(name or kind, kind, box, solids, made_of.surface, made_of.height)


def _legs(box: Box) -> tuple[Box, ...]:
    """Four legs in the corners of a box."""
    return tuple(
        Box(x, y, x + LEG, y + LEG) for y in (box.y0, box.y1 - LEG) for x in (box.x0, box.x1 - LEG)
    )


def numbered(pieces: list[Piece]) -> tuple[Piece, ...]:
    """The same pieces with unique names: "chair", "chair 2", "chair 3"."""
    count: dict[str, int] = {}
    out = []
    for one in pieces:
        count[one.kind] = count.get(one.kind, 0) + 1
        suffix = f" {count[one.kind]}" if count[one.kind] > 1 else ""
        out.append(replace(one, name=one.kind + suffix))
    return tuple(out)
