from __future__ import annotations

import numpy as np

from core.segmentation.connected import (
    border_lengths,
    connect_regions,
    largest_component,
    reachable_floor,
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


def test_a_leak_behind_a_crack_is_no_floor_and_a_doorway_is_no_crack() -> None:
    free = np.zeros((20, 64), bool)
    free[1:19, 1:20] = free[1:19, 22:41] = free[1:19, 43:62] = True
    free[6:14, 20:22] = True  # a doorway of eight cells
    free[9, 41:43] = True  # a crack of one cell
    floor = reachable_floor(free, np.array([[10, 5], [10, 21], [10, 30]]), 3)
    assert floor[10, 5]
    assert floor[10, 30]
    assert not floor[:, 43:].any()
    assert (free & ~floor)[:, :41].sum() == 0
