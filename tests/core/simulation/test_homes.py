"""Homes by name: the paper's, random ones, the special ones."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from core.errors import InputError, UsageError
from core.simulation import Home, build_home, home_names, truth_of
from core.simulation.home_truth import cells_in
from core.simulation.homes import NAMED, WIDEST_ROBOT
from core.simulation.route_planner import RoutePlanner

SEEDS = [1, 2, 6, 13, 1000, 1001]


@pytest.fixture(scope="module")
def random_homes() -> list[Home]:
    return [build_home(f"random-{seed}") for seed in SEEDS]


def test_the_paper_home_has_the_papers_size_and_rooms(paper: Home) -> None:
    plan = paper.bounds.grown(-0.1)
    assert (plan.width, plan.height) == pytest.approx((11.4, 8.7))
    with_doors = [r for r in paper.rooms if r.kind in ("bedroom", "study")]
    assert len(with_doors) == 3
    assert {"kitchen", "living room"} <= {room.name for room in paper.rooms}
    living = paper.room("living room").boxes[0]
    for name in ("sofa", "coffee table"):
        box = paper.piece(name).footprint
        assert min(box.x0 - living.x0, living.x1 - box.x1) > 1.0


@pytest.mark.parametrize("name", sorted(NAMED))
def test_every_named_home_can_be_driven_through(name: str) -> None:
    home = build_home(name)
    planner = RoutePlanner(home, 0.22)
    for number in range(1, len(home.rooms) + 1):
        assert planner.passable[planner.truth.rooms == number].mean() > 0.2


def test_random_homes_have_four_to_ten_rooms_with_furniture(random_homes: list[Home]) -> None:
    for home in random_homes:
        assert 4 <= len(home.rooms) <= 10
        assert len(home.furniture) > 2 * len(home.rooms)
        assert "sofa" in {piece.kind for piece in home.furniture}


def test_every_room_of_a_random_home_can_be_entered(random_homes: list[Home]) -> None:
    for home in random_homes:
        passable = RoutePlanner(home, WIDEST_ROBOT).passable
        rooms = truth_of(home).rooms
        for number, room in enumerate(home.rooms, 1):
            assert passable[rooms == number].sum() * 0.05**2 > 0.6, (home.name, room.name)


def test_every_door_of_a_random_home_can_be_passed(random_homes: list[Home]) -> None:
    for home in random_homes:
        planner = RoutePlanner(home, WIDEST_ROBOT)
        for door in home.doors:
            inside = planner.passable[cells_in(door.gap, planner.geometry)]
            across = inside.any(axis=0) if door.passed_along_x else inside.any(axis=1)
            assert across.all(), (home.name, door.name)


def test_no_two_pieces_stand_in_each_other_or_in_a_wall(random_homes: list[Home]) -> None:
    for home in random_homes:
        for one, two in itertools.combinations(home.furniture, 2):
            assert not one.footprint.overlaps(two.footprint), (home.name, one.name, two.name)
        for piece in home.furniture:
            assert not any(piece.footprint.overlaps(wall) for wall in home.walls)


def test_a_number_gives_the_same_home_every_time(random_homes: list[Home]) -> None:
    assert build_home(f"random-{SEEDS[0]}") == random_homes[0]
    assert random_homes[0] != random_homes[1]


def test_plans_vary(random_homes: list[Home]) -> None:
    kinds = {room.kind for home in random_homes for room in home.rooms}
    assert {"corridor", "kitchen", "bathroom", "bedroom", "living room"} <= kinds
    assert any(len(room.boxes) > 1 for home in random_homes for room in home.rooms)


def test_the_mirrored_home_looks_the_same_from_all_four_rooms() -> None:
    occupied = truth_of(build_home("mirrored")).occupied
    assert np.array_equal(occupied, occupied[::-1])
    assert np.array_equal(occupied, occupied[:, ::-1])
    assert np.array_equal(occupied, np.rot90(occupied))


@pytest.mark.parametrize("name", ["palace", "random-", "random--1", "random-x", ""])
def test_an_unknown_home_is_a_usage_error_that_lists_the_known(name: str) -> None:
    with pytest.raises(UsageError, match="paper"):
        build_home(name)


def test_names_are_listed() -> None:
    assert home_names()[0] == "paper"
    assert "random-N" in home_names()


def test_what_is_not_there_cannot_be_carried_out(paper: Home) -> None:
    with pytest.raises(InputError, match="no piece of furniture 'piano'"):
        paper.without("piano")
    with pytest.raises(InputError, match="no door"):
        paper.with_shut("door 99")


def test_truth_marks_walls_furniture_and_rooms(paper: Home) -> None:
    truth = truth_of(paper)

    def at(x: float, y: float) -> tuple[bool, int]:
        row, col = truth.geometry.cell_of((x, y))
        return bool(truth.occupied[row, col]), int(truth.rooms[row, col])

    assert at(5.8, 5.0) == (True, 0)  # the sofa
    assert at(-0.05, 4.0) == (True, 0)  # an outer wall
    assert at(5.0, 4.0) == (False, 1 + [r.name for r in paper.rooms].index("living room"))
    shut = truth_of(paper.with_shut("door 1"))
    assert shut.occupied.sum() > truth.occupied.sum()
