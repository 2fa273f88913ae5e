import numpy as np
import pytest

from core.segmentation.convexity import ConvexityConfig, convexity
from core.segmentation.decision import Decision, measure_cut


def test_the_cut_of_two_rooms_lies_in_the_door(two_rooms):
    grid = two_rooms
    part = grid.free.copy()
    part[:, round(4.6 / 0.05) :] = False
    config = ConvexityConfig()
    c1 = convexity((grid.free,), grid, config)
    measures = measure_cut(part, grid.free, c1, grid, config)
    (line,) = measures.cut
    assert all(x == pytest.approx(4.6) for x, _ in line)
    assert measures.cut_width_m == pytest.approx(0.75)
    assert measures.c2 < c1
    # 15 grids of border, 80 x 70 and two grids more of door on the left
    rest = grid.free.sum() - part.sum()
    assert measures.ncut == pytest.approx(15 / part.sum() + 15 / rest)


def test_the_hull_of_a_rectangle_has_its_corners(square_map):
    measures = measure_cut(square_map.free, square_map.free, 0.0, square_map, ConvexityConfig())
    assert sorted(measures.hull) == [[0.525, 0.525], [0.525, 3.975], [3.975, 0.525], [3.975, 3.975]]
    assert measures.cut == []


def test_an_entry_of_the_history_is_plain_json(square_map):
    measures = measure_cut(square_map.free, square_map.free, 0.0, square_map, ConvexityConfig())
    entry = Decision(1, measures, 0.0, True, "convex", 7, (3,)).entry()
    assert (entry["region"], entry["came_from"], entry["accepted"]) == (7, [3], True)
    assert all(isinstance(v, float) for corner in entry["hull"] for v in corner)
    assert np.isfinite(entry["ncut"])
