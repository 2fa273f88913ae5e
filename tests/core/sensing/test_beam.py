from __future__ import annotations

import math

import numpy as np
import pytest

from core.sensing.beam import directivity, sound_pressure


def test_the_directivity_is_one_on_the_axis_and_a_quarter_at_the_edge_of_the_beam() -> None:
    assert directivity(0.0, math.radians(50)) == pytest.approx(1.0)
    assert directivity(math.radians(25), math.radians(50)) == pytest.approx(0.25, abs=1e-3)


def test_pressure_falls_with_the_square_of_the_distance() -> None:
    near, far = sound_pressure(np.array([0.5, 2.0]), 0.1, 0.6)
    assert near / far == pytest.approx(16)
