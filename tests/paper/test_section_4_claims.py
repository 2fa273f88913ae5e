"""What Sect. 4 of the paper claims about localization, on hand-made maps."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.localization.distance_vector import dissimilarity, distance_vector
from core.localization.entropy_test import entropy_of
from core.localization.motion_model import (
    EffectiveMotionConfig,
    angle_transition,
    distance_transition,
)
from core.localization.node_probability import posterior, prior
from core.localization.paper_localizer import PaperLocalizer
from core.localization.ring_projection import correlation, ring_vector, ring_vectors
from core.localization.template import template_of
from core.mapping import OccupancyGrid
from core.mapping.map_result import MapResult
from core.mapping.occupancy_grid import GridGeometry
from core.sensing import RING_PRESETS, RobotLog
from core.topology import Model
from core.topology.topology_of import topology_of

RING = RING_PRESETS["paper-12"]
ROOM = (40, 30)
"""The robot's cell of `home()` that templates are cut around."""
RADIUS = 18


def home() -> np.ndarray:
    """Occupied cells (80, 160): two rooms of unlike shape, furniture in both, a door between them."""
    occupied = np.zeros((80, 160), bool)
    occupied[[10, 70], 5:150] = True
    occupied[10:71, [5, 90, 149]] = True
    occupied[38:48, 90] = False
    occupied[25:33, 15:22] = True
    occupied[50:52, 30:44] = True
    occupied[30:60, 120:123] = True
    return occupied


def around(occupied: np.ndarray, cell: tuple[int, int]) -> np.ndarray:
    row, col = cell
    return occupied[row - RADIUS : row + RADIUS + 1, col - RADIUS : col + RADIUS + 1]


def test_4_1_the_template_holds_the_grids_of_more_than_average_confidence() -> None:
    geometry = GridGeometry(0.1, (0.0, 0.0, 0.0), (20, 20))
    occupied = np.zeros((20, 20), bool)
    occupied[[4, 4, 12, 18], [3, 9, 5, 18]] = True
    confidence = np.zeros((20, 20))
    confidence[4, 3] = confidence[4, 9] = confidence[12, 5] = 5.0
    confidence[18, 18] = 1.0  # the average of all is 4
    grid = OccupancyGrid.of(geometry, ~occupied, occupied)
    witnesses = np.ones(grid.geometry.shape, np.int64)
    template = template_of(MapResult(grid, confidence, np.ones((1, 1), bool), witnesses))
    assert template is not None
    assert template.occupied.shape == (9, 7)
    assert template.occupied.sum() == 3
    assert template.radius == 3  # half of the shorter side (4.2.1)
    assert template.centre == pytest.approx(geometry.world_of(np.array([8.0, 6.0])))


@pytest.mark.parametrize("quarter_turns", [0, 1, 2, 3])
def test_4_2_1_the_place_is_found_whatever_the_heading(quarter_turns: int) -> None:
    occupied = home()
    template = np.rot90(around(occupied, ROOM), quarter_turns)
    own = ring_vector(template, (RADIUS, RADIUS), RADIUS)
    cells = np.argwhere(~occupied)
    rho = correlation(own, ring_vectors(occupied, cells, RADIUS))
    assert rho.max() == pytest.approx(1.0)
    assert tuple(cells[rho.argmax()]) == ROOM


@pytest.mark.parametrize("quarter_turns", [0, 1, 2, 3])
def test_4_2_2_the_distance_vector_tells_the_heading(quarter_turns: int) -> None:
    occupied = home()
    turned = np.rot90(around(occupied, ROOM), -quarter_turns)  # rows grow upwards: a left turn
    template = distance_vector(turned, RADIUS, RADIUS, RADIUS)
    difference, turn = dissimilarity(template, distance_vector(occupied, *ROOM, RADIUS))
    elsewhere, _ = dissimilarity(template, distance_vector(occupied, 45, 135, RADIUS))
    assert turn == pytest.approx(90 * quarter_turns, abs=1)
    assert difference < 0.25 * elsewhere


def test_4_3_2_the_driven_distance_decides_between_two_places_that_match_alike() -> None:
    before, now = np.array([[0.0, 0.0], [9.0, 9.0]]), np.array([[2.5, 0.0], [6.0, 0.0]])
    known, alike = np.array([1.0, 0.0]), np.array([0.5, 0.5])
    transition = distance_transition(before, now, 2.5, EffectiveMotionConfig())
    p = posterior(alike, prior(transition, known))
    assert p[0] > 0.999


def test_4_3_3_the_turn_decides_between_places_at_the_same_distance() -> None:
    config = EffectiveMotionConfig()
    earlier, before = np.array([[0.0, 0.0]] * 2), np.array([[2.0, 0.0]] * 2)
    left_or_right = np.array([[2.0, 2.5], [2.0, -2.5]])
    distance = distance_transition(before, left_or_right, 2.5, config)
    assert distance[0] == pytest.approx(distance[1])  # the distance alone cannot tell
    known = np.array([1.0, 0.0])
    angle = angle_transition(
        earlier, before, left_or_right, math.pi / 2, np.full((2, 2), 0.5), config
    )
    p = posterior(np.array([0.5, 0.5]), prior(distance * angle, known))
    assert p[0] > 0.999


def test_4_3_4_entropy_falls_as_a_belief_gathers_in_one_node() -> None:
    gathering = [np.array([a, *[(1 - a) / 9] * 9]) for a in (0.1, 0.3, 0.6, 0.9, 1.0)]
    entropies = [entropy_of(p) for p in gathering]
    assert entropies[0] == pytest.approx(1.0)
    assert entropies == sorted(entropies, reverse=True)
    assert entropies[-1] == 0.0


def test_4_3_4_the_local_map_grows_until_a_step_is_accepted() -> None:
    occupied = home()
    geometry = GridGeometry(0.05, (0.0, 0.0, 0.0), occupied.shape)
    rows, cols = np.mgrid[:80, :160]
    inside = ~occupied & (rows > 10) & (rows < 70) & (cols > 5) & (cols < 149)
    grid = OccupancyGrid.of(geometry, inside, occupied)
    regions = np.where(inside, np.where(cols < 90, 1, 2), 0)
    model = Model(grid, regions, regions, topology_of(grid, regions), None, {})
    method = PaperLocalizer(model)
    state = method.start()
    for part, scans in ((silent(0, 6), 6), (silent(5, 11), 11)):
        state, step = method.advance(state, part)
        assert not step.updated
        assert state.growing is not None
        assert len(state.growing) == scans
    heard = silent(10, 16)
    heard.ranges[:] = 1.0
    state, step = method.advance(state, heard)
    assert step.updated
    assert state.growing is None


def silent(first: int, end: int) -> RobotLog:
    """Scans without any echo, 10 cm apart on a straight line."""
    t = np.arange(first, end) * 0.25
    odometry = np.column_stack((0.4 * t, np.zeros((len(t), 2))))
    shape = (len(t), len(RING))
    return RobotLog("silent", RING, t, odometry, np.full(shape, np.nan), np.ones(shape, bool))
