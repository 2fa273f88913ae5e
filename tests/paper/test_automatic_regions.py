"""Section 3.1 on maps drawn by hand, where a person knows the right cut.

`#` wall, `.` floor; other characters are floor too and name the place that a grid belongs to. One
character is 0.25 m x 0.25 m, five grids of 5 cm.
"""

import numpy as np
import pytest

from core.evaluation.clustering import adjusted_rand
from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.automatic import segment_automatically
from core.segmentation.hidden_pairs import hidden_pairs
from core.segmentation.offline import segment_offline

BLOCK = 5
MOST_HIDDEN = 0.2
"""The paper's c_t: a region with no more of it is one place."""


def walled(rows):
    width = len(rows[0]) + 2
    return ["#" * width, *[f"#{row}#" for row in rows], "#" * width]


TWO_ROOMS = walled(
    ["a" * 16 + "#" + "b" * 16] * 6
    + ["a" * 16 + "." + "b" * 16] * 3
    + ["a" * 16 + "#" + "b" * 16] * 6
)  # fmt: skip
L = walled(["a" * 8 + "#" * 16] * 16 + ["." * 8 + "b" * 16] * 8)
CORRIDOR = walled(
    ["a" * 12 + "#" + "b" * 12 + "#" + "c" * 12] * 12
    + [("#" * 5 + "..." + "#" * 4 + "#") * 2 + "#" * 5 + "..." + "#" * 4]
    + ["d" * 38] * 6
)
T = walled(["#" * 14 + "a" * 8 + "#" * 14] * 16 + ["b" * 14 + "." * 8 + "c" * 14] * 8)
DRAWINGS = {"two rooms and a door": TWO_ROOMS, "L": L, "corridor": CORRIDOR, "T": T}
PLACES = {"two rooms and a door": 2, "L": 2, "corridor": 4, "T": 3}


def map_of(drawing):
    """The map and the place (0 = not told) of each grid."""
    characters = np.array([list(line) for line in drawing[::-1]])
    places = np.where(np.isin(characters, ["#", "."]), 0, characters.view(np.uint32) - ord("a") + 1)
    state = np.where(characters == "#", 2, 1)
    block = np.ones((BLOCK, BLOCK), int)
    state = np.kron(state, block).astype(np.uint8)
    geometry = GridGeometry(0.05, (0.0, 0.0, 0.0), state.shape)
    return OccupancyGrid(geometry, state), np.kron(places, block)


def agreement(found, places):
    """Adjusted Rand index over the grids whose place is told."""
    told = places > 0
    return adjusted_rand(found[told], places[told])


@pytest.mark.parametrize("name", DRAWINGS)
def test_the_normalized_cut_finds_the_places_when_their_number_is_told(name):
    grid, places = map_of(DRAWINGS[name])
    assert agreement(segment_offline(grid.free, PLACES[name]), places) > 0.75


@pytest.mark.parametrize("name", ["two rooms and a door", "corridor"])
def test_rooms_behind_doors_are_found_without_their_number(name):
    grid, places = map_of(DRAWINGS[name])
    found = segment_automatically(grid)
    assert found.rooms.max() == PLACES[name]
    assert agreement(found.rooms, places) > 0.95


@pytest.mark.parametrize("name", ["L", "T"])
def test_the_arm_is_cut_off_the_bar_without_their_number(name):
    grid, places = map_of(DRAWINGS[name])
    found = segment_automatically(grid)
    # The bar of the T sees all of itself: its two ends are one place.
    arm, bar = places == 1, places > 1
    assert found.regions.max() == 2
    assert agreement(found.regions, np.where(arm, 1, np.where(bar, 2, 0))) > 0.75


@pytest.mark.parametrize("name", DRAWINGS)
def test_every_region_is_seen_whole_from_within(name):
    grid, _ = map_of(DRAWINGS[name])
    found = segment_automatically(grid)
    for value in range(1, found.regions.max() + 1):
        assert hidden_pairs(found.regions == value, ~grid.free) <= MOST_HIDDEN
