from __future__ import annotations

import numpy as np

from app.viewer.floor_image import LIGHT
from app.viewer.moment_picture import MOST_SCALE, STRIPE, moment_picture
from core.mapping.occupancy_grid import FREE, OCCUPIED, UNKNOWN
from core.segmentation.step_picture import StepPicture

COLOUR = (10, 200, 30)


def picture_of(state: int, cluster: int = 0, region: int = 0, colours=None) -> np.ndarray:
    shape = (20, 20)
    step = StepPicture(
        np.full(shape, state, np.uint8), np.full(shape, cluster), np.full(shape, region)
    )
    return moment_picture(step, colours or {}, LIGHT)


def test_what_is_unknown_is_not_painted() -> None:
    picture = picture_of(UNKNOWN, region=1)
    assert picture.shape == (20 * MOST_SCALE, 20 * MOST_SCALE, 4)
    assert (picture == 0).all()


def test_free_and_occupied_have_the_colours_of_the_floor() -> None:
    assert (picture_of(FREE) == (*LIGHT.free, 255)).all()
    assert (picture_of(OCCUPIED) == (*LIGHT.occupied, 255)).all()


def test_an_extracted_region_has_the_tint_of_its_colour_in_the_model() -> None:
    picture = picture_of(FREE, region=3, colours={3: COLOUR})
    expected = np.array(LIGHT.free) + LIGHT.tint * (np.array(COLOUR) - LIGHT.free)
    assert np.abs(picture[..., :3].astype(float) - expected).max() < 1


def test_a_tentative_part_is_striped() -> None:
    picture = picture_of(FREE, cluster=2)
    row = picture[0, :, :3]
    bare = (row == LIGHT.free).all(axis=1)
    assert bare.sum() == 20 * MOST_SCALE // 2
    assert (np.diff(np.flatnonzero(np.diff(bare.astype(int)))) == STRIPE).all()
