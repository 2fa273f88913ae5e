"""Homes by name."""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np

from core.errors import InputError, UsageError
from core.simulation.furnishing import furnished
from core.simulation.home import Home, make_doors
from core.simulation.home_truth import truth_of
from core.simulation.paper_home import paper_home
from core.simulation.random_plan import random_plan
from core.simulation.route_planner import RoutePlanner
from core.simulation.special_homes import corridor_home, hall_home, mirrored_home, office_home

NAMED: dict[str, Callable[[], Home]] = {
    "paper": paper_home,
    "mirrored": mirrored_home,
    "corridor": corridor_home,
    "hall": hall_home,
    "office": office_home,
}
"""The homes that are not made from a number."""
RANDOM = re.compile(r"random-(\d{1,9})")
WIDEST_ROBOT = 0.26
"""Every room of a random home can be entered by a robot of this radius (m)."""
ATTEMPTS = 20
"""Random homes are made anew at most this often until every room can be entered."""
REACHED = 0.25
"""A room is entered when the robot's centre can be on this share of its open floor."""


def home_names() -> list[str]:
    """The names that `build_home` takes; `random-N` stands for any number N."""
    return [*NAMED, "random-N"]


def build_home(name: str) -> Home:
    """The home of that name: one of NAMED, or `random-N`, a furnished home of 4-10 rooms.

    Raises:
        UsageError: there is no such home.
    """
    if name in NAMED:
        return NAMED[name]()
    match = RANDOM.fullmatch(name)
    if match is None:
        raise UsageError(f"there is no home {name!r}; there are {', '.join(home_names())}")
    return random_home(int(match[1]), name)


def random_home(seed: int, name: str) -> Home:
    """A furnished home of 4-10 rooms; the same seed gives the same home."""
    for attempt in range(ATTEMPTS):
        rng = np.random.default_rng([seed, attempt])
        plan = random_plan(rng)
        try:
            empty = Home(name, plan.rooms, make_doors(plan.rooms, plan.openings))
        except InputError:
            continue
        home = furnished(empty, rng)
        if _can_be_entered(home):
            return home
    raise UsageError(f"no home came of {name!r}; take another number")


def _can_be_entered(home: Home) -> bool:
    """Whether the robot can get into every room."""
    passable = RoutePlanner(home, WIDEST_ROBOT).passable
    rooms = truth_of(home).rooms
    return all(
        passable[rooms == number].mean() >= REACHED for number in range(1, len(home.rooms) + 1)
    )
