"""The sentence that says why."""

from __future__ import annotations

import numpy as np

from core.localization.explanation import explain

NAMES = ("kitchen", "bath", "hall")
POSES = np.array([[1.0, 1.0, 0.0], [5.0, 1.0, 0.0], [1.3, 1.0, 0.0]])


def told(p: list[float], fits: list[float], unknown: float = 0.0) -> str:
    return explain(NAMES, np.array(p), unknown, np.array(fits), 2.5, POSES)


def test_a_sure_belief_names_its_place_and_the_next_best() -> None:
    text = told([0.95, 0.05, 0.0], [0.82, 0.41, 0.3])
    assert text == "moved 2.5 m; the echoes fit kitchen at 0.82, bath at 0.41"


def test_two_places_far_apart_that_fit_alike_look_the_same() -> None:
    text = told([0.5, 0.5, 0.0], [0.82, 0.80, 0.3])
    assert text.endswith("; kitchen looks the same as bath")


def test_two_sides_of_a_border_do_not_look_the_same() -> None:
    text = told([0.5, 0.0, 0.5], [0.82, 0.3, 0.80])
    assert text.endswith("; it could also be hall")


def test_readings_that_fit_nowhere_are_said_to() -> None:
    assert "nowhere on the map" in told([0.1, 0.1, 0.0], [0.3, 0.2, 0.1], unknown=0.8)
