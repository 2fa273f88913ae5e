"""The parts of the pose-grid filter."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.localization.expected_range import (
    NOTHING,
    OPEN,
    RANGE_STEP,
    ExpectedRangeConfig,
    beam_codes,
    ray_codes,
)
from core.localization.pose_grid import PoseBelief, PoseGrid
from core.localization.pose_motion import PoseMotionConfig, predict
from core.localization.sonar_likelihood import (
    NO_ECHO,
    SonarLikelihoodConfig,
    likelihood_table,
    reading_codes,
)
from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import GridGeometry
from core.topology import Model

EXACT = PoseMotionConfig(0.0, 0.0, 0.0, 0.0, 0.0, kidnapped=0.0, leaves=0.0, enters=0.0)


def open_floor() -> PoseGrid:
    return PoseGrid(GridGeometry(0.1, (0.0, 0.0, 0.0), (40, 50)), np.ones((40, 50), bool), 72)


def test_expected_range_is_the_distance_of_the_wall(two_rooms: Model) -> None:
    rays = ray_codes(two_rooms.grid, ExpectedRangeConfig())
    row, col = rays.geometry.cell_of((2.0, 2.5))
    x = rays.geometry.world_of((row, col))[0]
    seen = rays.codes[:, row, col] * RANGE_STEP
    assert seen[0] == pytest.approx(4.0 - x, abs=0.06)  # east: the wall between the rooms
    assert seen[72] == pytest.approx(x, abs=0.06)  # west


def test_a_beam_answers_with_its_nearest_surface(two_rooms: Model) -> None:
    config = ExpectedRangeConfig()
    rays = ray_codes(two_rooms.grid, config)
    row, col = rays.geometry.cell_of((3.5, 1.5))  # looks through the door
    beam = beam_codes(rays, math.radians(90), config)
    assert rays.codes[0, row, col] * RANGE_STEP == pytest.approx(3.6, abs=0.1)
    # within +-45 degrees the corner of the door is nearest, at about 0.7 m
    assert beam[0, row, col] * RANGE_STEP == pytest.approx(0.7, abs=0.12)


def test_unknown_ground_is_an_open_border() -> None:
    geometry = GridGeometry(0.05, (0.0, 0.0, 0.0), (40, 40))
    free = np.zeros((40, 40), bool)
    free[10:30, 10:30] = True
    rays = ray_codes(OccupancyGrid.of(geometry, free, np.zeros_like(free)), ExpectedRangeConfig())
    code = int(rays.codes[0, 10, 10])
    assert code >= OPEN
    assert (code & NOTHING) * RANGE_STEP == pytest.approx(0.45, abs=0.06)


def test_reading_codes_mark_silence() -> None:
    assert reading_codes(np.array([1.0, np.nan, 0.0])).tolist() == [20, NO_ECHO, 0]


def test_a_reading_of_the_expected_range_speaks_for_the_place(two_rooms: Model) -> None:
    config = ExpectedRangeConfig()
    rays = ray_codes(two_rooms.grid, config)
    codes = np.stack((beam_codes(rays, 0.9, config), rays.codes), axis=-1)
    table = likelihood_table(codes, rays.standable, 4.0, SonarLikelihoodConfig())
    ratio = table[:, 0, 40] + table[:, 1, 40]  # a surface at 2 m
    assert ratio[40] > 3
    assert ratio[:NO_ECHO].argmax() in (40, 41)
    assert ratio[20] < 0.5
    assert np.isfinite(table).all()
    assert (table > 0).all()


def test_an_exact_motion_moves_the_mass_to_the_pose_it_leads_to() -> None:
    grid = open_floor()
    mass = np.zeros((72, 40, 50), np.float32)
    mass[18, 10, 20] = 1.0  # looks north
    moved = predict(PoseBelief(mass, 0.0), grid, (1.0, 0.0, math.pi / 2), 1.0, 1.6, EXACT)
    assert moved.mass[36, 20, 20] == pytest.approx(1.0, abs=1e-3)


def test_mass_of_kidnapped_robots_is_everywhere() -> None:
    grid = open_floor()
    mass = np.zeros((72, 40, 50), np.float32)
    mass[0, 10, 10] = 1.0
    config = PoseMotionConfig(kidnapped=0.01, leaves=0.0)
    moved = predict(PoseBelief(mass, 0.0), grid, (0.0, 0.0, 0.0), 0.0, 0.0, config)
    assert moved.mass.min() == pytest.approx(0.01 / grid.poses, rel=1e-3)


@settings(max_examples=20, deadline=None)
@given(
    st.floats(-3, 3),
    st.floats(-3, 3),
    st.floats(-3.1, 3.1),
    st.floats(0, 1),
)
def test_mass_and_unknown_sum_to_one_after_any_motion(
    dx: float, dy: float, turn: float, unknown: float
) -> None:
    grid = open_floor()
    start = PoseBelief.anywhere(grid, unknown)
    moved = predict(start, grid, (dx, dy, turn), math.hypot(dx, dy), abs(turn), PoseMotionConfig())
    assert moved.mass.sum(dtype=float) + moved.unknown == pytest.approx(1.0, abs=1e-4)
    assert (moved.mass >= 0).all()
