"""What a map is like as a whole."""

from __future__ import annotations

import numpy as np
import pytest

from core.segmentation.map_character import map_character


def test_specks_and_furniture_are_told_by_the_floor_they_stand_on() -> None:
    bare = np.ones((20, 30), bool)
    floor = bare.copy()
    floor[5:10, 5:15] = False  # a table of 50 cells
    free = floor.copy()
    free[15, 4] = free[15, 20] = free[2, 2] = False
    found = map_character(free, floor, bare, resolution=0.5)
    assert found.area == pytest.approx(550 * 0.25)
    assert found.specks == pytest.approx(3 / (550 * 0.25))
    assert found.furniture == pytest.approx(50 / 550)


def test_an_empty_hall_has_neither() -> None:
    hall = np.ones((10, 10), bool)
    found = map_character(hall, hall, hall, resolution=0.1)
    assert (found.area, found.specks, found.furniture) == (pytest.approx(1.0), 0.0, 0.0)
