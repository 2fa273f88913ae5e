import numpy as np

from core.segmentation.boundary_tracing import trace_boundary


def test_a_square_of_three_is_traced_around_its_middle():
    mask = np.zeros((5, 5), bool)
    mask[1:4, 1:4] = True
    path = trace_boundary(mask)
    assert len(path) == 8
    assert [2, 2] not in path.tolist()


def test_the_trace_is_closed_and_steps_to_neighbours():
    mask = np.zeros((12, 12), bool)
    mask[2:9, 3:5] = True
    mask[6:9, 3:11] = True
    path = trace_boundary(mask)
    steps = np.abs(np.diff(np.vstack((path, path[:1])), axis=0)).max(axis=1)
    assert (steps == 1).all()


def test_a_single_cell_is_its_own_boundary():
    mask = np.zeros((3, 3), bool)
    mask[1, 1] = True
    assert trace_boundary(mask).tolist() == [[1, 1]]
