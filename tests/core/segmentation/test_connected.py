from __future__ import annotations

import numpy as np

from core.segmentation.connected import (
    border_lengths,
    connect_regions,
    largest_component,
    renumber,
)


def test_the_smaller_piece_of_a_region_joins_its_neighbour() -> None:
    regions = np.array([[1, 1, 1, 2, 2, 1]])
    assert connect_regions(regions).tolist() == [[1, 1, 1, 2, 2, 2]]


def test_a_piece_that_touches_another_piece_only_follows_it() -> None:
    regions = np.array([[1, 1, 1, 2, 2, 2, 1, 3, 0, 3, 3]])
    assert connect_regions(regions).tolist() == [[1, 1, 1, 2, 2, 2, 2, 2, 0, 3, 3]]


def test_the_component_that_the_robot_was_in_is_taken() -> None:
    mask = np.array([[1, 1, 1, 0, 1]], bool)
    assert largest_component(mask).sum() == 3
    assert largest_component(mask, np.array([[0, 4]])).tolist() == [[0, 0, 0, 0, 1]]


def test_border_lengths_count_neighbouring_grids() -> None:
    assert border_lengths(np.array([[1, 2], [1, 2], [3, 3]])) == {(1, 2): 2, (1, 3): 1, (2, 3): 1}


def test_regions_are_numbered_from_the_lowest_row() -> None:
    assert renumber(np.array([[0, 7, 7], [4, 4, 9]])).tolist() == [[0, 1, 1], [2, 2, 3]]
