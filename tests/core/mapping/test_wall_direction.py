"""The direction of walls from reflecting points."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.mapping.wall_direction import wall_direction, wall_sharpness, wrap_quarter


def room(turned: float, noise: float = 0.02) -> tuple[np.ndarray, np.ndarray]:
    """Points on the four walls of a room of 4 m x 6 m turned by an angle, seen from inside."""
    rng = np.random.default_rng(0)
    along = rng.uniform(-1, 1, 400)
    side = rng.integers(0, 4, 400)
    x = np.choose(side, [np.full(400, 2.0), np.full(400, -2.0), 2 * along, 2 * along])
    y = np.choose(side, [3 * along, 3 * along, np.full(400, 3.0), np.full(400, -3.0)])
    view = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])[side]
    points = np.column_stack((x, y)) + noise * rng.standard_normal((400, 2))
    c, s = math.cos(turned), math.sin(turned)
    turn = np.array([(c, s), (-s, c)])
    return points @ turn, view @ turn


@pytest.mark.parametrize("degrees", [-44.0, -20.0, 0.0, 3.3, 44.0])
def test_the_direction_of_a_turned_room_is_found(degrees: float) -> None:
    found = wall_direction(*room(math.radians(degrees)))

    assert found is not None
    assert abs(float(wrap_quarter(found - math.radians(degrees)))) < math.radians(0.5)


def test_points_without_walls_have_no_direction() -> None:
    angle = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    view = np.column_stack((np.cos(angle), np.sin(angle)))

    assert wall_direction(3 * view, view) is None


def test_a_handful_of_points_has_no_direction() -> None:
    points, views = room(0.0)

    assert wall_direction(points[:10], views[:10]) is None


def test_straight_walls_are_sharper_than_bent_ones() -> None:
    points, views = room(0.0)
    bent = points.copy()
    bent[:, 0] += 0.05 * points[:, 1] ** 2

    assert wall_sharpness(points, views) > 1.2 * wall_sharpness(bent, views)
