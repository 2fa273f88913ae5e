import math

import numpy as np
import pytest

from core.segmentation.automatic import AutomaticConfig, draft_of
from core.segmentation.merge_tree import MergeTree, TreeNode, merge_tree
from core.segmentation.merging import RegionGraph, judged, merge
from core.segmentation.room_features import FEATURES, NOTHING

RESOLUTION = 0.05
OPEN_SHARE = 6
"""The feature that these tests judge borders by: the share of the common border that is no wall."""


def by_walls(_, features):
    """The more wall there is beside a border, the likelier it is real."""
    return 0.5 - features[:, OPEN_SHARE]


@pytest.fixture
def graph():
    """Three rooms in a row, a door from each to the next."""
    free = np.zeros((80, 246), bool)
    for left in (3, 83, 163):
        free[3:77, left : left + 77] = True
    for wall in (80, 160):
        free[30:48, wall : wall + 3] = True
    config = AutomaticConfig()
    cells, around = draft_of(free, ~free, RESOLUTION, config.draft, config.clutter)
    graph = RegionGraph(cells, around)
    judged(graph, graph.pairs(), by_walls)
    return graph


def chain(*joins):
    """A tree of as many draft cells as it takes to join these pairs of nodes."""
    leaves = [TreeNode(i, (), NOTHING, NOTHING) for i in range(len(joins) + 1)]
    nodes = [*leaves, *(TreeNode(a, (a, b), 0.0, 0.0) for a, b in joins)]
    return MergeTree(tuple(nodes), np.zeros((len(nodes), 1)))


def test_the_greatest_worth_is_chosen_and_every_draft_cell_is_in_one_region():
    tree = chain((0, 1), (3, 2))  # nodes 0 1 2, 3 = 0 + 1, 4 = all
    assert tree.best(np.array([0.1, 0.1, 0.4, 0.3, 0.5])) == [2, 3]
    assert tree.best(np.array([0.1, 0.1, 0.4, 0.3, 0.8])) == [4]
    assert tree.best(np.array([0.3, 0.1, 0.4, 0.3, 0.5])) == [0, 1, 2]


def test_parts_that_are_worth_as_much_stay_together():
    assert chain((0, 1)).best(np.array([0.25, 0.25, 0.5])) == [2]


def test_regions_that_touch_nothing_are_chosen_on_their_own():
    nodes = tuple(TreeNode(i, (), NOTHING, NOTHING) for i in range(2))
    assert MergeTree(nodes, np.zeros((2, 1))).best(np.array([-0.4, 0.1])) == [0, 1]


def test_mergers_lead_to_what_is_chosen():
    tree = chain((0, 1), (4, 2), (5, 3))
    assert tree.mergers([5, 3]) == [(0, 1), (0, 2)]
    assert tree.mergers([0, 1, 2, 3]) == []


def test_the_tree_ends_in_one_region_and_knows_the_features_of_each(graph):
    cells = len(graph.shapes)
    tree = merge_tree(graph.copy(), by_walls)
    assert len(tree.nodes) == 2 * cells - 1
    assert tree.features.shape == (2 * cells - 1, len(FEATURES))
    assert np.isfinite(tree.features).all()
    area = np.exp(tree.features[:, 0])
    assert area[-1] == pytest.approx(area[:cells].sum())
    for node in tree.nodes[cells:]:
        assert node.inside == max(node.joined, *(tree.nodes[part].inside for part in node.parts))


def test_a_copy_merges_on_its_own(graph):
    before = {pair: graph.features(pair) for pair in graph.pairs()}
    merge_tree(graph.copy(), by_walls)
    assert {pair: graph.features(pair) for pair in graph.pairs()} == before
    assert (graph.parent == np.arange(len(graph.parent))).all()


def test_merging_stops_where_borders_are_likely_and_tells_of_every_merger(graph):
    told = []
    cells = len(graph.shapes)
    merge(graph, by_walls, 0.0, lambda *merger: told.append(merger))
    assert all(odds < 0 for _, _, odds in told)
    assert len(graph.shapes) == cells - len(told) == 3
    assert all(graph.borders[a][b].log_odds >= 0 for a, b in graph.pairs())


def test_without_end_merging_joins_all_that_touches(graph):
    merge(graph, by_walls, math.inf)
    assert len(graph.shapes) == 1
