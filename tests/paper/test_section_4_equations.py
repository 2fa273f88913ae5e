"""The paper's equations with values that can be computed by hand (eq. 10-21)."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.localization.distance_vector import dissimilarity, distance_vector
from core.localization.entropy_test import EntropyTestConfig, entropy_of, is_accepted
from core.localization.matching import distance_similarity, matching_probability
from core.localization.motion_model import (
    EffectiveMotionConfig,
    angle_transition,
    came_from,
    distance_transition,
    effective_angles,
    effective_distances,
)
from core.localization.node_probability import posterior, prior
from core.localization.ring_projection import (
    correlation,
    ring_of_offsets,
    ring_vector,
    ring_vectors,
)


def test_rings_of_a_square_of_offsets() -> None:
    ring = ring_of_offsets(2)
    assert ring[2, 2] == 0
    assert ring[2, 3] == ring[1, 1] == 1  # distances 1 and 1.41
    assert ring[2, 4] == ring[0, 0] == 2  # distances 2 and 2.83
    assert ring_of_offsets(3)[0, 0] == -1  # distance 4.24


def test_ring_vector_is_the_share_of_occupied_grids_in_each_ring() -> None:
    occupied = np.zeros((7, 7), bool)
    occupied[3, 4] = occupied[2, 2] = True
    assert ring_vector(occupied, (3, 3), 2).tolist() == [0.0, 2 / 8, 0.0]


def test_ring_vectors_of_all_cells_equal_those_of_single_cells() -> None:
    occupied = np.random.default_rng(1).uniform(size=(20, 31)) < 0.2
    cells = np.array([[0, 0], [10, 15], [19, 30]])
    many = ring_vectors(occupied, cells, 6)
    for i, (row, col) in enumerate(cells):
        assert np.allclose(many[i], ring_vector(occupied, (row, col), 6), atol=1e-6)


@given(st.integers(0, 3), st.integers(0, 1000))
def test_ring_vector_does_not_change_under_quarter_turns(turns: int, seed: int) -> None:
    occupied = np.random.default_rng(seed).uniform(size=(15, 15)) < 0.3
    turned = np.rot90(occupied, turns)
    assert np.allclose(ring_vector(occupied, (7, 7), 7), ring_vector(turned, (7, 7), 7))


def test_ring_vector_of_a_disc_border_hardly_changes_under_any_rotation() -> None:
    angles = np.linspace(0, 2 * np.pi, 60)[:40]

    def drawn(turn: float) -> np.ndarray:
        grid = np.zeros((61, 61), bool)
        rows = np.round(30 + 20.5 * np.sin(angles + turn)).astype(int)
        grid[rows, np.round(30 + 20.5 * np.cos(angles + turn)).astype(int)] = True
        return grid

    off = ring_vector(drawn(0.0), (30, 30), 25) - ring_vector(drawn(0.7), (30, 30), 25)
    assert np.abs(off).sum() < 0.35


def test_correlation_is_one_for_the_same_shape_and_minus_one_for_its_negative() -> None:
    template = np.array([0.0, 0.5, 1.0])
    places = np.array([[0.0, 0.5, 1.0], [0.2, 0.3, 0.4], [1.0, 0.5, 0.0], [0.3, 0.3, 0.3]])
    assert np.allclose(correlation(template, places), [1, 1, -1, 0])


def test_distance_vector_of_a_square_room() -> None:
    occupied = np.ones((21, 21), bool)
    occupied[1:20, 1:20] = False
    d = distance_vector(occupied, 10, 10, 100)
    assert d[[0, 90, 180, 270]] == pytest.approx(10)
    assert d[45] == pytest.approx(10 * math.sqrt(2), abs=0.8)


def test_direction_without_obstacle_has_the_cap() -> None:
    assert (distance_vector(np.zeros((9, 9), bool), 4, 4, 60) == 60).all()


@given(st.integers(0, 359))
def test_a_turned_distance_vector_is_found_at_its_turn(turn: int) -> None:
    place = np.random.default_rng(3).uniform(1, 5, 360)
    assert dissimilarity(np.roll(place, turn), place) == (0.0, turn)


def test_distance_similarity_shares_the_inverse_differences() -> None:
    assert distance_similarity(np.array([1.0, 2.0, 4.0])) == pytest.approx([4 / 7, 2 / 7, 1 / 7])


def test_match_is_the_product_and_negative_correlation_is_none() -> None:
    match = matching_probability(np.array([0.5, 0.3, 0.2]), np.array([0.8, 1.0, -0.5]))
    assert match == pytest.approx([0.4, 0.3, 0.0])


def test_effective_distance_of_a_three_four_five_triangle() -> None:
    before, now = np.array([[0.0, 0.0]]), np.array([[3.0, 4.0]])
    assert effective_distances(before, now) == pytest.approx(np.array([[5.0]]))


def test_left_turn_has_an_effective_angle_of_ninety_degrees() -> None:
    k, j, i = np.array([[0.0, 0.0]]), np.array([[1.0, 0.0]]), np.array([[1.0, 2.0]])
    assert effective_angles(k, j, i)[0, 0, 0] == pytest.approx(math.pi / 2)


def test_distance_transition_is_the_normal_density_of_the_distance() -> None:
    before, now = np.array([[0.0, 0.0], [9.0, 0.0]]), np.array([[2.0, 0.0], [2.5, 0.0]])
    p = distance_transition(before, now, 2.0, EffectiveMotionConfig())
    peak = 1 / (0.5 * math.sqrt(2 * math.pi))
    assert p[0, 0] == pytest.approx(peak)
    assert p[1, 0] == pytest.approx(peak * math.exp(-0.5))  # one sigma of 0.5 m off


def test_angle_transition_prefers_the_node_that_lies_straight_on() -> None:
    earlier, before = np.array([[0.0, 0.0]] * 2), np.array([[2.0, 0.0]] * 2)
    now = np.array([[4.0, 0.0], [2.0, 2.0]])
    p = angle_transition(earlier, before, now, 0.0, np.full((2, 2), 0.5), EffectiveMotionConfig())
    assert p[0, 0] > 1000 * p[1, 0]


def test_came_from_is_bayes() -> None:
    transition = np.array([[0.9, 0.1], [0.2, 0.8]])  # [j, k]
    p = came_from(transition, np.array([0.5, 0.5]))
    assert p[:, 0] == pytest.approx([0.9, 0.1])
    assert p.sum(axis=0) == pytest.approx([1.0, 1.0])


def test_prior_and_posterior_of_two_nodes() -> None:
    before = prior(np.array([[0.8, 0.2], [0.2, 0.8]]), np.array([1.0, 0.0]))
    assert before == pytest.approx([0.8, 0.2])
    assert posterior(np.array([0.1, 0.4]), before) == pytest.approx([0.5, 0.5])


@pytest.mark.parametrize("match", [[0.0, 0.0], [np.nan, 1.0], [np.inf, 1.0]])
def test_a_match_that_says_nothing_gives_equal_probabilities(match: list[float]) -> None:
    assert posterior(np.array(match), np.array([0.5, 0.5])) == pytest.approx([0.5, 0.5])


def test_entropy_is_one_without_idea_and_zero_when_certain() -> None:
    assert entropy_of(np.full(10, 0.1)) == pytest.approx(1.0)
    assert entropy_of(np.array([1.0, 0.0, 0.0])) == 0.0
    assert entropy_of(np.array([0.5, 0.5, 0.0, 0.0])) == pytest.approx(0.5)  # log_4 2


def test_entropy_test_rejects_a_rise_only_while_unsure() -> None:
    config = EntropyTestConfig(sure=0.9)
    unsure, worse, sure = np.array([0.7, 0.3]), np.array([0.6, 0.4]), np.array([0.95, 0.05])
    assert not is_accepted(unsure, worse, config)
    assert is_accepted(worse, unsure, config)
    assert is_accepted(sure, worse, config)
