from __future__ import annotations

import numpy as np
import pytest
from scipy import sparse

from core.segmentation.normalized_cut import normalized_cut, normalized_cut_value


def two_cliques(bridge: float) -> sparse.csr_array:
    """Two cliques of four vertices joined by one edge."""
    weights = np.zeros((8, 8))
    weights[:4, :4] = weights[4:, 4:] = 1
    np.fill_diagonal(weights, 0)
    weights[3, 4] = weights[4, 3] = bridge
    return sparse.csr_array(weights)


def test_two_cliques_are_cut_at_their_bridge() -> None:
    cluster = normalized_cut(two_cliques(0.5), 2, np.random.default_rng(0))
    assert len(set(cluster[:4])) == len(set(cluster[4:])) == 1
    assert cluster[0] != cluster[7]


def test_the_value_of_a_cut_is_that_of_eq_1() -> None:
    cluster = np.array([0] * 4 + [1] * 4)
    assert normalized_cut_value(two_cliques(0.5), cluster) == pytest.approx(2 * 0.5 / 12.5)


def test_one_cluster_holds_all_and_n_clusters_hold_one_each() -> None:
    rng = np.random.default_rng(0)
    assert set(normalized_cut(two_cliques(1), 1, rng)) == {0}
    assert sorted(normalized_cut(two_cliques(1), 8, rng)) == list(range(8))


def test_the_same_seed_gives_the_same_clusters() -> None:
    first = normalized_cut(two_cliques(1), 3, np.random.default_rng(5))
    np.testing.assert_array_equal(
        first, normalized_cut(two_cliques(1), 3, np.random.default_rng(5))
    )
