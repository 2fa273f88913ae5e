import math

import numpy as np
import pytest
from skimage.draw import line

from core.segmentation.main_axis import main_axis

RIGHT_ANGLE = math.pi / 2


@pytest.mark.parametrize("degrees", [0, 20, 40])
def test_the_axis_is_that_of_the_walls_whichever_of_both_directions_they_have(degrees):
    wall = np.zeros((200, 200), bool)
    along = np.array([math.sin(math.radians(degrees)), math.cos(math.radians(degrees))])
    across = np.array([along[1], -along[0]])
    for direction in (along, across):
        start, stop = (np.rint(100 + sign * 80 * direction).astype(int) for sign in (-1, 1))
        wall[line(*start, *stop)] = True
    off = (main_axis(wall) - math.radians(degrees)) % RIGHT_ANGLE
    assert min(off, RIGHT_ANGLE - off) < math.radians(2)
