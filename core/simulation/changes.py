"""How a home changes between two visits (paper, Sect. 5.3): things are gone or moved, a door is shut."""

from __future__ import annotations

import zlib

import numpy as np

from core.simulation.home import WIDEST_DOOR, Home
from core.simulation.route_planner import RoutePlanner

SEATS = ("armchair", "sofa")
"""The paper carries out a 70 cm x 70 cm sofa; an armchair is the first choice."""
PUSH = (0.4, 0.8)
"""A chair that stays in its room is pushed this far (m)."""
LIKELY_GONE = 0.5
"""Share of chairs that are carried out rather than pushed."""
ROBOT_RADIUS = 0.26
"""Doors are shut so that a robot of this radius (m) still reaches most of the home."""
STILL_REACHED = 0.55
"""Share of the floor that must stay reachable when a door is shut."""


def changed_home(home: Home, seed: int) -> Home:
    """The home with a seat carried out, a chair gone or pushed, and a door shut, as far as it has them."""
    rng = np.random.default_rng([seed, zlib.crc32(f"{home.name}/changes".encode())])
    return _one_door_shut(_chair_changed(_seat_gone(home, rng), rng), rng)


def _seat_gone(home: Home, rng: np.random.Generator) -> Home:
    for kind in SEATS:
        seats = [piece for piece in home.furniture if piece.kind == kind]
        if seats:
            return home.without(seats[int(rng.integers(len(seats)))].name)
    return home


def _chair_changed(home: Home, rng: np.random.Generator) -> Home:
    chairs = [piece for piece in home.furniture if piece.kind == "chair"]
    if not chairs:
        return home
    chair = chairs[int(rng.integers(len(chairs)))]
    without = home.without(chair.name)
    if rng.random() < LIKELY_GONE:
        return without
    taken = [wall.grown(0.02) for wall in home.walls]
    taken += [piece.footprint for piece in without.furniture]
    for angle in rng.permutation(8) * np.pi / 4:
        distance = rng.uniform(*PUSH)
        dx, dy = round(distance * np.cos(angle), 2), round(distance * np.sin(angle), 2)
        there = chair.moved(dx, dy)
        if not any(there.footprint.overlaps(box) for box in taken):
            return home.with_moved(chair.name, dx, dy)
    return without


def _one_door_shut(home: Home, rng: np.random.Generator) -> Home:
    doors = [door for door in home.doors if door.width <= WIDEST_DOOR]
    reached = RoutePlanner(home, ROBOT_RADIUS).passable.sum()
    for i in rng.permutation(len(doors)):
        after = home.with_shut(doors[int(i)].name)
        if RoutePlanner(after, ROBOT_RADIUS).passable.sum() >= STILL_REACHED * reached:
            return after
    return home
