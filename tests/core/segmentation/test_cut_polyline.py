import numpy as np

from core.segmentation.cut_polyline import cut_polylines


def test_a_straight_border_is_a_straight_line():
    first, second = np.zeros((8, 10), bool), np.zeros((8, 10), bool)
    first[1:7, 1:5], second[1:7, 5:9] = True, True
    lines, length = cut_polylines(first, second)
    assert length == 6
    assert [sorted(map(tuple, line)) for line in lines] == [[(1.0, 4.5), (6.0, 4.5)]]


def test_two_doorways_are_two_lines():
    first, second = np.zeros((20, 10), bool), np.zeros((20, 10), bool)
    first[:, :5], second[:, 5:] = True, True
    second[5:15, 5] = False
    lines, length = cut_polylines(first, second)
    assert length == 10
    assert sorted(len(line) for line in lines) == [2, 2]


def test_masks_that_do_not_touch_have_no_line():
    first, second = np.zeros((5, 5), bool), np.zeros((5, 5), bool)
    first[0], second[2] = True, True
    assert cut_polylines(first, second) == ([], 0)
