"""Grey-scale reconstruction: peaks cut down, everything below them filled again."""

from __future__ import annotations

import numpy as np
import skimage.morphology

from core.segmentation.reconstruction import reconstruction


def test_a_peak_is_cut_to_the_height_that_its_seed_reaches() -> None:
    mask = np.array([[0.0, 3.0, 1.0, 5.0, 0.0]])
    assert reconstruction(mask - 1, mask).tolist() == [[0.0, 2.0, 1.0, 4.0, 0.0]]


def test_a_lower_peak_is_filled_up_to_the_pass_that_leads_to_a_higher_one() -> None:
    mask = np.array([[3.0, 2.5, 9.0]])
    assert reconstruction(mask - 1, mask).tolist() == [[2.5, 2.5, 8.0]]


def test_winding_ways_are_filled_to_their_ends_as_by_scikit_image() -> None:
    rng = np.random.default_rng(0)
    passable = np.kron(rng.random((40, 60)) > 0.5, np.ones((2, 2)))
    mask = passable * rng.uniform(0.5, 1.0, passable.shape)
    seed = np.zeros(mask.shape)
    seed[np.unravel_index(mask.argmax(), mask.shape)] = mask.max()
    expected = skimage.morphology.reconstruction(seed, mask)  # type: ignore[no-untyped-call]
    assert (expected > seed).sum() > 1000
    np.testing.assert_array_equal(reconstruction(seed, mask), expected)
