"""Region metrics on two rooms."""

from __future__ import annotations

import numpy as np
import pytest

from core.evaluation import GroundTruth, region_metrics
from core.evaluation.clustering import adjusted_rand
from core.evaluation.region_metrics import hidden_share
from core.mapping.occupancy_grid import GridGeometry

GEOMETRY = GridGeometry(0.05, (0.0, 0.0, 0.0), (10, 21))


def two_rooms() -> GroundTruth:
    """10 x 10 cells each, a wall of one cell between them."""
    occupied = np.zeros((10, 21), bool)
    occupied[:, 10] = True
    rooms = np.ones((10, 21), np.int64)
    rooms[:, 11:] = 2
    free = ~occupied
    return GroundTruth(
        GEOMETRY, occupied, free, free, np.where(free, rooms, 0), ("a", "b"), np.zeros((0, 4))
    )


def test_one_region_per_room_is_perfect() -> None:
    truth = two_rooms()
    m = region_metrics(truth.rooms * 7, GEOMETRY, truth)
    assert (m.count, m.rooms_true, m.coverage, m.purity, m.ari) == (2, 2, 1.0, 1.0, 1.0)
    assert (m.best_iou_mean, m.merged_iou_mean, m.hidden_max) == (1.0, 1.0, 0.0)
    assert m.smallest_m2 == pytest.approx(100 * 0.05**2)


def test_one_region_over_both_rooms_is_half_pure_and_half_hidden() -> None:
    truth = two_rooms()
    m = region_metrics(np.where(truth.free, 1, 0), GEOMETRY, truth)
    assert (m.count, m.purity, m.ari) == (1, 0.5, 0.0)
    assert m.hidden_max == pytest.approx(0.5, abs=0.08)
    assert m.rooms["a"].best_iou == 0.5


def test_a_room_cut_in_two_keeps_purity_and_merged_overlap() -> None:
    truth = two_rooms()
    regions = truth.rooms.copy()
    regions[:5, 11:] = 3
    m = region_metrics(regions, GEOMETRY, truth)
    assert (m.count, m.purity, m.merged_iou_mean) == (3, 1.0, 1.0)
    assert m.rooms["b"].best_iou == 0.5
    assert 0.5 < m.ari < 1.0


def test_floor_without_region_is_not_covered() -> None:
    truth = two_rooms()
    m = region_metrics(np.where(truth.rooms == 1, 1, 0), GEOMETRY, truth)
    assert (m.coverage, m.purity, m.count) == (0.5, 1.0, 1)


def test_no_region_at_all() -> None:
    truth = two_rooms()
    m = region_metrics(np.zeros((10, 21), np.int64), GEOMETRY, truth)
    assert (m.count, m.coverage, m.purity, m.best_iou_mean) == (0, 0.0, 0.0, 0.0)


def test_nothing_is_hidden_in_an_empty_rectangle() -> None:
    assert hidden_share(np.ones((8, 12), bool), np.zeros((8, 12), bool)) == 0.0


def test_adjusted_rand_of_a_known_table() -> None:
    # table 2 1 / 1 2: pairs together 2, in rows 6, in columns 6, of 15
    first, second = np.array([0, 0, 0, 1, 1, 1]), np.array([0, 0, 1, 0, 1, 1])
    expected = (2 - 36 / 15) / (6 - 36 / 15)
    assert adjusted_rand(first, second) == pytest.approx(expected)
    assert adjusted_rand(first, 5 - first) == 1.0
