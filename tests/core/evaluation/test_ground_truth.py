"""Alignment of a map with the truth, and sampling between grids."""

from __future__ import annotations

import numpy as np
import pytest

from core.evaluation.ground_truth import GroundTruth, aligned, aligned_grid, alignment, sampled
from core.geometry import compose, inverse
from core.mapping.occupancy_grid import GridGeometry, OccupancyGrid

SHIFT = np.array([2.0, -1.0, 0.7])


def test_alignment_finds_the_motion_between_two_frames() -> None:
    rng = np.random.default_rng(0)
    truth = np.column_stack((rng.uniform(0, 10, (50, 2)), rng.uniform(-3, 3, 50)))
    in_map = compose(inverse(SHIFT), truth)
    assert alignment(truth, in_map) == pytest.approx(SHIFT)


def test_an_aligned_map_has_its_cells_where_the_truth_has_them() -> None:
    state = np.zeros((4, 6), np.uint8)
    state[3, 1] = 2
    grid = OccupancyGrid(GridGeometry(0.1, (1.0, 2.0, 0.2), (4, 6)), state)
    moved = aligned_grid(grid, SHIFT)
    before = grid.geometry.world_of(np.argwhere(grid.occupied))[0]
    after = moved.geometry.world_of(np.argwhere(moved.occupied))[0]
    assert after == pytest.approx(compose(SHIFT, np.array([*before, 0.0]))[:2])
    assert aligned(grid.geometry, np.zeros(3)).origin == pytest.approx(grid.geometry.origin)


def test_sampling_outside_gives_the_fill_value() -> None:
    geometry = GridGeometry(1.0, (0.0, 0.0, 0.0), (2, 2))
    image = np.array([[1, 2], [3, 4]])
    points = np.array([[0.5, 0.5], [1.5, 0.5], [0.5, 1.5], [-0.5, 0.5], [2.5, 0.5]])
    assert sampled(image, geometry, points, -1).tolist() == [1, 2, 3, -1, -1]


def test_padding_keeps_every_cell_in_its_place() -> None:
    occupied = np.array([[True, False], [True, True]])
    truth = GroundTruth(
        GridGeometry(0.05, (1.0, 2.0, 0.0), (2, 2)),
        occupied,
        ~occupied,
        ~occupied,
        (~occupied).astype(np.int64),
        ("room",),
        np.zeros((0, 4)),
    )
    padded = truth.padded(0.1)
    assert padded.geometry.shape == (6, 6)
    assert padded.occupied.sum() == 36 - 1
    free = padded.geometry.world_of(np.argwhere(padded.free))[0]
    assert free == pytest.approx(truth.geometry.world_of(np.argwhere(truth.free))[0])
