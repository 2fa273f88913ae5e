from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from core.segmentation.cell_decomposition import affinity, decompose

masks = hnp.arrays(bool, hnp.array_shapes(min_dims=2, max_dims=2, min_side=1, max_side=20))


@given(masks)
def test_the_cells_cover_the_mask_exactly(mask: np.ndarray) -> None:
    cells = decompose(mask)
    np.testing.assert_array_equal(cells.index >= 0, mask)
    assert (cells.size**2).sum() == mask.sum()
    for i, (row, col, size) in enumerate(zip(cells.row, cells.col, cells.size, strict=True)):
        assert (cells.index[row : row + size, col : col + size] == i).all()


@given(masks, st.sampled_from([1, 2, 4]))
def test_no_cell_is_larger_than_allowed(mask: np.ndarray, largest: int) -> None:
    assert decompose(mask, largest).size.max(initial=0) <= largest


def test_a_square_with_one_obstacle_is_cut_into_quarters_around_it() -> None:
    mask = np.ones((4, 4), bool)
    mask[0, 0] = False
    cells = decompose(mask)
    assert sorted(cells.size.tolist()) == [1, 1, 1, 2, 2, 2]


def test_weights_count_the_adjacent_grids() -> None:
    mask = np.ones((2, 4), bool)
    mask[0, 3] = False
    cells = decompose(mask)
    weights = affinity(cells).toarray()
    large = int(np.flatnonzero(cells.size == 2)[0])
    np.testing.assert_array_equal(weights, weights.T)
    assert weights[large].sum() == 2  # eq. (3): two grids touch the right half
    assert weights.sum() == 2 * (2 + 1 + 1)
