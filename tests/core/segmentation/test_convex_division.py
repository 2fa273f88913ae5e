import numpy as np

from core.segmentation.convex_division import DivisionConfig, divided
from core.segmentation.hidden_pairs import hidden_pairs

CONFIG = DivisionConfig()


def parts_of(grid):
    labels = divided(grid.free, ~grid.free, 0.05, CONFIG)
    assert ((labels > 0) == grid.free).all()
    return labels


def test_a_room_stays_whole(square_map):
    assert parts_of(square_map).max() == 1


def test_two_rooms_are_parted_at_the_door(two_rooms):
    labels = parts_of(two_rooms)
    assert labels.max() == 2
    assert len(np.unique(labels[:, : round(4.4 / 0.05)])) == 2
    assert len(np.unique(labels[:, round(4.9 / 0.05) :])) == 2


def test_every_part_of_a_corridor_with_rooms_is_convex(corridor_with_three_rooms):
    grid = corridor_with_three_rooms
    labels = parts_of(grid)
    shares = [hidden_pairs(labels == v, ~grid.free, 2000, 5) for v in range(1, labels.max() + 1)]
    assert len(shares) == 4
    assert max(shares) <= CONFIG.most_hidden + 0.03


def test_nothing_is_divided_into_nothing():
    nothing = np.zeros((4, 4), bool)
    assert divided(nothing, ~nothing, 0.05, CONFIG).max() == 0
