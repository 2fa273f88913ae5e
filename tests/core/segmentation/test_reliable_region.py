import numpy as np

from core.segmentation.reliable_region import ReliableConfig, confident_grids, reliable_region


def test_near_grids_dominate_the_mean_but_not_a_low_percentile():
    occupied = np.ones((1, 10), bool)
    confidence = np.array([[100.0, *[1.0 + k for k in range(9)]]])
    mean = confident_grids(confidence, occupied, ReliableConfig("mean"))
    assert mean.sum() == 1
    assert confident_grids(confidence, occupied).sum() == 8


def test_a_room_with_certain_walls_is_reliable_as_a_whole(square_map):
    grid = square_map
    rng = np.random.default_rng(0)
    confidence = np.where(grid.occupied, 1 + rng.random(grid.state.shape), 0.0)
    seed = np.array(grid.geometry.shape) // 2
    region = reliable_region(grid, confidence, seed)
    assert region.sum() > 0.95 * grid.free.sum()
    assert not (region & ~grid.free).any()
