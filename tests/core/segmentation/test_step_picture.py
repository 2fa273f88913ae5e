import io

import numpy as np
import pytest
from PIL import Image

from core.errors import ModelError
from core.segmentation.step_picture import StepPicture


def picture() -> StepPicture:
    state = np.array([[0, 1, 2], [1, 1, 1]], np.uint8)
    clusters = np.array([[0, 5, 0], [63, 0, 0]])
    regions = np.array([[0, 0, 0], [0, 300, 65535]])
    return StepPicture(state, clusters, regions)


def test_a_picture_reads_back_the_same():
    back = StepPicture.read(picture().png())
    for layer in ("state", "clusters", "regions"):
        np.testing.assert_array_equal(getattr(back, layer), getattr(picture(), layer))


def test_the_encoding_is_as_documented_with_row_0_at_the_top():
    pixels = np.asarray(Image.open(io.BytesIO(picture().png())))
    assert pixels[0].tolist() == [[1 + 4 * 63, 0, 0], [1, 1, 44], [1, 255, 255]]
    assert pixels[1].tolist() == [[0, 0, 0], [1 + 4 * 5, 0, 0], [2, 0, 0]]


def test_a_picture_is_placed_in_a_larger_grid_and_cut_at_its_border():
    placed = picture().placed((1, -1), (4, 4))
    assert placed.state.tolist() == [[0, 0, 0, 0], [1, 2, 0, 0], [1, 1, 0, 0], [0, 0, 0, 0]]
    assert placed.regions.max() == 65535
    assert picture().placed((9, 9), (4, 4)).state.max() == 0


@pytest.mark.parametrize("content", [b"", b"no picture", picture().png()[:60]])
def test_what_is_no_picture_is_refused(content):
    with pytest.raises(ModelError, match="picture of a step"):
        StepPicture.read(content)


def test_a_grey_picture_is_refused():
    file = io.BytesIO()
    Image.new("L", (3, 3)).save(file, "PNG")
    with pytest.raises(ModelError, match="RGB"):
        StepPicture.read(file.getvalue())
