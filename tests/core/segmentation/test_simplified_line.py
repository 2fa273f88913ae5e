import subprocess
import sys

import numpy as np

from core.segmentation.simplified_line import simplified_line


def test_points_on_a_straight_line_go():
    line = np.array([[0, 0], [1, 1], [2, 2], [3, 3]], float)
    assert simplified_line(line, 0.1).tolist() == [[0, 0], [3, 3]]


def test_a_corner_beyond_the_tolerance_stays():
    line = np.array([[0, 0], [0, 5], [1, 10], [0, 15], [0, 20]], float)
    assert simplified_line(line, 0.9).tolist() == [[0, 0], [1, 10], [0, 20]]
    assert simplified_line(line, 1.1).tolist() == [[0, 0], [0, 20]]


def test_a_closed_square_keeps_its_corners():
    square = np.array([[0, 0], [0, 2], [0, 4], [4, 4], [4, 2], [4, 0], [2, 0], [0, 0]], float)
    corners = [[0, 0], [0, 4], [4, 4], [4, 0], [0, 0]]
    assert simplified_line(square, 0.5).tolist() == corners


def test_a_point_behind_an_end_counts_by_its_distance_to_that_end():
    line = np.array([[0, 0], [0, -3], [0, 4]], float)
    assert len(simplified_line(line, 2.9)) == 3
    assert len(simplified_line(line, 3.1)) == 2


def test_modelling_does_not_load_the_statistics_of_scipy():
    code = "import sys, core.pipeline.modeller; sys.exit('scipy.stats' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
