"""Labels give way to each other."""

from __future__ import annotations

import numpy as np

from app.viewer.camera import fit_top
from app.viewer.label_layout import LabelBox, visible_labels

VIEW = fit_top(np.array([(0.0, 0.0), (10.0, 8.0)]), 1.25)


def shown(*labels: LabelBox) -> list[bool]:
    return visible_labels(labels, VIEW, picture_height=800, scale=1.0)


def test_labels_that_are_apart_are_all_shown():
    a = LabelBox("kitchen", (2.0, 2.0, 0.0), 1.0)
    b = LabelBox("hall", (8.0, 6.0, 0.0), 1.0)
    assert shown(a, b) == [True, True]


def test_of_two_that_overlap_the_weightier_is_shown():
    small = LabelBox("pantry", (5.0, 4.0, 0.0), 3.0)
    large = LabelBox("living room", (5.2, 4.05, 0.0), 30.0)
    assert shown(small, large) == [False, True]
    assert shown(large, small) == [True, False]


def test_of_two_alike_the_first_is_shown():
    a, b = (LabelBox("room", (5.0, 4.0, 0.0), 1.0) for _ in range(2))
    assert shown(a, b) == [True, False]


def test_a_small_picture_shows_fewer():
    a = LabelBox("living room", (4.0, 4.0, 0.0), 1.0)
    b = LabelBox("kitchen", (6.0, 4.0, 0.0), 1.0)
    assert visible_labels((a, b), VIEW, 800, 1.0) == [True, True]
    assert visible_labels((a, b), VIEW, 150, 1.0) == [True, False]


def test_a_label_behind_the_camera_is_hidden():
    assert shown(LabelBox("attic", (5.0, 4.0, 1000.0), 1.0)) == [False]


def test_no_labels():
    assert shown() == []
