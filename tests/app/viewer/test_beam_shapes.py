"""Beams point where the sonars do, and end at what they heard or as far as they could have."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.viewer.beam_shapes import MISS_SHARE, UNSEEN, arc, fan, plan_beams
from core.sensing.ring import RING_PRESETS

RING = RING_PRESETS["circle-8"]


def test_a_beam_starts_at_its_transducer_and_ends_at_its_echo():
    ranges = np.full(8, np.nan)
    ranges[0] = 1.5
    plan = plan_beams(RING, np.array([2.0, 3.0, math.pi / 2]), ranges)
    mount = RING.sonars[0]
    assert plan.feet[0].tolist() == pytest.approx([2.0 - mount.y, 3.0 + mount.x])
    assert plan.headings[0] == pytest.approx(mount.heading + math.pi / 2)
    assert plan.reaches.tolist() == pytest.approx([1.5] + [RING.sonars[1].max_range] * 7)
    assert plan.echoes.tolist() == [True] + [False] * 7


def test_beams_without_an_echo_are_narrow_and_hidden_ones_vanish():
    plan = plan_beams(RING, np.zeros(3), np.array([2.0, *[np.nan] * 7]))
    scales = plan.scales(np.ones(8, bool))
    assert scales[0].tolist() == pytest.approx([2.0, 2.0, 1.0])
    assert scales[1, 1] == pytest.approx(MISS_SHARE * RING.sonars[1].max_range)
    assert (plan.scales(plan.echoes)[1:] == UNSEEN).all()


def test_the_shapes_span_the_beam():
    for shape in (fan(1.0), arc(1.0)):
        angles = np.arctan2(shape.vertices[:, 1], shape.vertices[:, 0])
        assert angles.min() == pytest.approx(-0.5, abs=1e-6)
        assert angles.max() == pytest.approx(0.5, abs=1e-6)
        assert shape.faces.max() == len(shape.vertices) - 1
