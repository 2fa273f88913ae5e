"""What a better fit is worth: little between look-alike places, nearly all of it otherwise."""

from __future__ import annotations

import numpy as np
import pytest

from core.localization.evidence import EvidenceConfig, discounted, updated
from core.localization.pose_grid import PoseBelief
from core.localization.pose_observation import blocks_of

HEADINGS, SIDE = 24, 40
BEST_POSSIBLE = 300.0
HERE, THERE = (3, 5, 5), (15, 30, 30)


def belief_of(*peaks: tuple[int, int, int], unknown: float = 0.0) -> PoseBelief:
    mass = np.zeros((HEADINGS, SIDE, SIDE), np.float32)
    for peak in peaks:
        mass[peak] = (1 - unknown) / len(peaks)
    return PoseBelief(mass, unknown)


def after(
    prior: PoseBelief, scores: dict[tuple[int, int, int], float], outside: float = 0.0
) -> PoseBelief:
    score = np.full(prior.mass.shape, -50.0, np.float32)
    for pose, value in scores.items():
        score[pose] = value
    blocks = blocks_of(np.ones((SIDE, SIDE), bool))
    return updated(prior, score, blocks, outside, BEST_POSSIBLE, EvidenceConfig())


def test_a_gap_of_k_counts_half_and_its_sign_is_kept() -> None:
    gaps = np.array([0.0, 30.0, -30.0, 3.0, 300.0, 1e200])
    worth = discounted(gaps, 30.0, 4)
    assert worth[:3].tolist() == [0.0, 15.0, -15.0]
    assert worth[3] < 0.001
    assert worth[4] == pytest.approx(300.0, rel=1e-3)
    assert worth[5] == pytest.approx(1e200)


def test_look_alike_places_stay_level_step_after_step() -> None:
    belief = belief_of(HERE, THERE)
    for _ in range(20):
        belief = after(belief, {HERE: 160.0, THERE: 142.0})  # .06 of the best possible score apart
    assert belief.mass[HERE] == pytest.approx(0.5, abs=0.25)


def test_a_large_gap_decides_at_once() -> None:
    belief = after(belief_of(HERE, THERE), {HERE: 160.0, THERE: 20.0})
    assert belief.mass[HERE] > 0.999


def test_around_a_place_small_gaps_count_in_full() -> None:
    near = (HERE[0], HERE[1], HERE[2] + 1)
    belief = after(belief_of(HERE, near), {HERE: 160.0, near: 145.0})
    assert belief.mass[HERE] / belief.mass[near] == pytest.approx(np.exp(0.2 * 15.0), rel=1e-3)


def test_a_place_whose_peak_is_a_little_off_loses_nothing_to_its_copy() -> None:
    off = (THERE[0], THERE[1], THERE[2] + 1)
    belief = after(belief_of(HERE, THERE), {HERE: 160.0, THERE: 150.0, off: 160.0})
    assert belief.mass[HERE] == pytest.approx(0.5, abs=0.01)


def test_readings_that_fit_nowhere_speak_for_unknown() -> None:
    belief = after(belief_of(HERE, unknown=0.05), {HERE: -200.0}, outside=27.0)
    assert belief.unknown > 0.99


def test_an_update_sums_to_one_and_forgets_nothing_impossible() -> None:
    belief = after(belief_of(HERE, THERE, unknown=0.2), {HERE: -np.inf, THERE: -np.inf})
    assert belief.mass.sum() + belief.unknown == pytest.approx(1.0)
    assert belief.unknown == pytest.approx(1.0)
