"""Room metrics: F1, panoptic quality, over- and undersegmentation."""

from __future__ import annotations

import numpy as np
import pytest

from core.evaluation import room_metrics
from core.geometry import IntArray

FREE = np.ones((40, 40), bool)


def quarters() -> IntArray:
    """Four rooms of 20 x 20 cells."""
    truth = np.ones((40, 40), np.int64)
    truth[:, 20:] += 1
    truth[20:] += 2
    return truth


def test_the_truth_itself_is_perfect() -> None:
    m = room_metrics(quarters() * 3, quarters(), FREE)
    assert (m.f1, m.f1_75, m.pq, m.ari, m.over, m.under) == (1, 1, 1, 1, 0, 0)
    assert (m.segments, m.rooms) == (4, 4)


def test_two_rooms_in_one_segment() -> None:
    predicted = quarters()
    predicted[predicted == 2] = 1  # the two lower rooms
    m = room_metrics(predicted, quarters(), FREE)
    assert m.segments == 3
    assert m.f1 == pytest.approx(2 * 2 / 7)
    assert m.pq == pytest.approx(2 * 2 / 7)
    assert m.under == pytest.approx(2 / 4)
    assert m.over == 0


def test_a_room_cut_in_halves() -> None:
    predicted = quarters()
    predicted[:10, :20] = 9
    m = room_metrics(predicted, quarters(), FREE)
    assert m.over == pytest.approx(1 / 4)
    assert m.f1 == pytest.approx(2 * 3 / 9)  # a half has an IoU of 0.5, which is not more than 0.5


def test_panoptic_quality_counts_how_well_rooms_are_met() -> None:
    predicted = quarters()
    predicted[:4, :20] = 0  # 80 of 400 cells of the first room
    m = room_metrics(predicted, quarters(), FREE)
    assert m.f1 == 1.0
    assert m.pq == pytest.approx((3 + 320 / 400) / 4)


def test_slivers_and_cells_that_are_not_free_do_not_count() -> None:
    predicted = quarters()
    predicted[0, :] = 77  # 40 cells
    free = FREE.copy()
    free[0] = False
    m = room_metrics(predicted, quarters(), free)
    assert (m.segments, m.f1, m.pq) == (4, 1.0, 1.0)


def test_an_empty_prediction_scores_zero() -> None:
    m = room_metrics(np.zeros((40, 40), np.int64), quarters(), FREE)
    assert (m.f1, m.pq, m.segments, m.rooms) == (0, 0, 0, 4)
