"""The tree of all mergers of draft cells, and the rooms among its regions.

Merging goes on until all that touches is one. Every region on the way may be a room; which of them
are is chosen at once for the whole map (hierarchical merge trees: Liu et al., 2016, do the same for
images of neurons). Stopping at a likelihood of single borders cannot weigh what a region as a whole
looks like.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray
from core.segmentation.merging import Judge, RegionGraph, merge
from core.segmentation.room_features import NOTHING, room_features


@dataclass(frozen=True)
class TreeNode:
    """A region on the way.

    Attributes:
        region: its number in the graph.
        parts: the two nodes that it was joined of, none for a draft cell.
        joined: log-odds of the border between them, `NOTHING` for a draft cell.
        inside: the greatest of all such log-odds inside it.
    """

    region: int
    parts: tuple[int, ...]
    joined: float
    inside: float


@dataclass(frozen=True)
class MergeTree:
    """All regions on the way.

    Attributes:
        nodes: the draft cells first, then in the order of merging.
        features: (n, f) of each as a room, by `room_features`.
    """

    nodes: tuple[TreeNode, ...]
    features: FloatArray

    def best(self, worth: FloatArray) -> list[int]:
        """The nodes that share out the floor so that their worth (n,) is greatest, by dynamic
        programming from the draft cells up."""
        total, whole = worth.copy(), np.ones(len(worth), bool)
        for i, node in enumerate(self.nodes):
            if node.parts:
                below = float(total[list(node.parts)].sum())
                whole[i] = worth[i] >= below
                total[i] = max(worth[i], below)
        inner = {part for node in self.nodes for part in node.parts}
        chosen, waiting = [], [i for i in range(len(self.nodes)) if i not in inner]
        while waiting:
            i = waiting.pop()
            if whole[i]:
                chosen.append(i)
            else:
                waiting += self.nodes[i].parts
        return sorted(chosen)

    def mergers(self, chosen: list[int]) -> list[tuple[int, int]]:
        """Pairs (kept, gone) of regions in the order in which they join to the chosen nodes."""
        inside, waiting = [], list(chosen)
        while waiting:
            i = waiting.pop()
            if self.nodes[i].parts:
                inside.append(i)
                waiting += self.nodes[i].parts
        ends = (self.nodes[i].parts for i in sorted(inside))
        return [(self.nodes[a].region, self.nodes[b].region) for a, b in ends]


def merge_tree(graph: RegionGraph, judge: Judge) -> MergeTree:
    """Merges all of a graph, which is changed in place; its borders have been judged."""
    nodes: list[TreeNode] = []
    features: list[list[float]] = []
    latest: dict[int, int] = {}

    def add(node: TreeNode) -> None:
        latest[node.region] = len(nodes)
        nodes.append(node)
        features.append(room_features(graph, node.region, node.joined, node.inside))

    def merged(kept: int, gone: int, odds: float) -> None:
        a, b = nodes[latest[kept]], nodes[latest[gone]]
        inside = max(odds, a.inside, b.inside)
        add(TreeNode(kept, (latest[kept], latest[gone]), odds, inside))

    for region in sorted(graph.shapes):
        add(TreeNode(region, (), NOTHING, NOTHING))
    merge(graph, judge, math.inf, merged)
    return MergeTree(tuple(nodes), np.array(features))
