from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.mapping import GridGeometry, OccupancyGrid


@given(
    st.floats(-20, 20),
    st.floats(-20, 20),
    st.floats(-3, 3),
    st.integers(0, 9),
    st.integers(0, 6),
)
def test_the_centre_of_a_cell_lies_in_that_cell(
    x: float, y: float, heading: float, row: int, col: int
) -> None:
    geometry = GridGeometry(0.05, (x, y, heading), (10, 7))
    cell = np.array([row, col])
    np.testing.assert_array_equal(geometry.cell_of(geometry.world_of(cell)), cell)


def test_row_zero_is_the_lowest_y() -> None:
    geometry = GridGeometry(0.5, (-1.0, 2.0, 0.0), (4, 4))
    np.testing.assert_allclose(geometry.world_of([0, 0]), [-0.75, 2.25])
    np.testing.assert_array_equal(geometry.cell_of([0.9, 2.1]), [0, 3])


def test_a_grid_around_points_lines_up_with_other_grids() -> None:
    geometry = GridGeometry.around(np.array([[0.12, -0.31], [1.0, 0.4]]), 0.1, 0.05)
    corner = np.array(geometry.origin[:2]) / 0.05
    np.testing.assert_allclose(corner, np.round(corner), atol=1e-9)
    assert geometry.contains(geometry.cell_of(np.array([[0.12, -0.31], [1.0, 0.4]]))).all()


def test_occupied_wins_over_free() -> None:
    geometry = GridGeometry(0.05, (0.0, 0.0, 0.0), (1, 3))
    free = np.array([[True, True, False]])
    occupied = np.array([[False, True, False]])
    grid = OccupancyGrid.of(geometry, free, occupied)
    assert grid.free.tolist() == [[True, False, False]]
    assert grid.occupied.tolist() == [[False, True, False]]
    assert grid.unknown.tolist() == [[False, False, True]]
