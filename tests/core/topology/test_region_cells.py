import numpy as np

from core.topology.region_cells import region_cells

REGIONS = np.array([[0, 2, 2], [5, 0, 2]])


def test_cells_of_regions_come_in_the_order_asked_for():
    five, two = region_cells(REGIONS, [5, 2])
    assert five.tolist() == [[1, 0]]
    assert two.tolist() == [[0, 1], [0, 2], [1, 2]]


def test_a_region_that_is_not_there_has_no_cells():
    assert [cells.shape for cells in region_cells(REGIONS, [0, 3, 9])] == [(0, 2)] * 3
