"""What the judges of rooms learn from: borders and regions of maps with ground-truth rooms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from rooms_maps import MapOfRooms

import core.segmentation.boundary_features as boundary_features
import core.segmentation.room_features as room_features
from core.geometry import FloatArray
from core.segmentation.automatic import AutomaticConfig, draft_of
from core.segmentation.boundary_model import BoundaryModel
from core.segmentation.merge_tree import merge_tree
from core.segmentation.merging import RegionGraph, judged, merge

NEVER = 1e3
MET = -0.4
"""Log-odds up to which a model merges while it meets borders to learn from."""
FEWEST = 20
"""Cells of known rooms that a region must hold to be learned from."""
OPEN_SHARE = 6
"""The feature by which borders are merged in the order "open"."""


@dataclass(frozen=True)
class Samples:
    """Features (n, f), what they stand for (n,), weight (n,)."""

    features: FloatArray
    answer: FloatArray
    weight: FloatArray

    def __add__(self, other: Samples) -> Samples:
        return Samples(
            np.concatenate((self.features, other.features)),
            np.concatenate((self.answer, other.answer)),
            np.concatenate((self.weight, other.weight)),
        )


def as_samples(rows: list[tuple[list[float] | FloatArray, float, float]], width: int) -> Samples:
    """Samples of rows (features, answer, weight)."""
    if not rows:
        return Samples(np.zeros((0, width)), np.zeros(0), np.zeros(0))
    return Samples(*(np.array([row[i] for row in rows], float) for i in range(3)))


class Draft:
    """Draft cells of a map and how much of each true room they hold."""

    def __init__(self, entry: MapOfRooms, config: AutomaticConfig) -> None:
        grid = entry.grid
        self.cells, self.around = draft_of(
            grid.free, grid.occupied, grid.geometry.resolution, config.draft, config.clutter
        )
        known = (entry.truth > 0) & grid.free & (self.cells > 0)
        self.held = np.zeros((int(self.cells.max()) + 1, int(entry.truth.max()) + 1))
        np.add.at(self.held, (self.cells[known], entry.truth[known]), 1)
        self._graph = RegionGraph(self.cells, self.around)

    def borders(self, order: str, seed: int = 0, model: BoundaryModel | None = None) -> Samples:
        """Borders met while merging in an order: first, random, open or the model's own; whether
        each is real: most of the floor on both sides belongs to different rooms."""
        rng = np.random.default_rng(seed)
        graph = self._graph.copy()
        held = dict(enumerate(self.held))
        met: dict[tuple[int, int], tuple[FloatArray, float, float]] = {}

        def judge(pairs: list[tuple[int, int]], features: FloatArray) -> FloatArray:
            for gone in [region for region in held if graph.parent[region] != region]:
                held[graph.parent[gone]] = held[graph.parent[gone]] + held.pop(gone)
            own = model.log_odds(features) if model else np.full(len(pairs), NEVER)
            for k, (a, b) in enumerate(pairs):
                if min(held[a].sum(), held[b].sum()) < FEWEST:
                    continue
                share_a, share_b = held[a] / held[a].sum(), held[b] / held[b].sum()
                real = bool(share_a.argmax() != share_b.argmax())
                met[a, b] = (features[k], real, float(min(share_a.max(), share_b.max())) ** 3)
                if not model and order != "first" and not real:
                    own[k] = rng.random() if order == "random" else -features[k][OPEN_SHARE]
            return own

        def merged(_: int, gone: int, __: float) -> None:
            if not model:
                for pair in [p for p in met if gone in p and met[p][1]]:
                    del met[pair]

        judged(graph, graph.pairs(), judge)
        merge(graph, judge, MET if model else NEVER / 2, merged)
        return as_samples(list(met.values()), len(boundary_features.FEATURES))

    def first_borders(self) -> Samples:
        """Borders met in the orders that know no model."""
        random = self.borders("random", 1) + self.borders("random", 2)
        return self.borders("first") + random + self.borders("open")

    def regions(self, model: BoundaryModel) -> Samples:
        """All regions on the way and the overlap (IoU) of each with its best true room, 0 up to one
        half."""
        graph = self._graph.copy()

        def judge(_: list[tuple[int, int]], features: FloatArray) -> FloatArray:
            return model.log_odds(features)

        judged(graph, graph.pairs(), judge)
        tree = merge_tree(graph, judge)
        held: list[FloatArray] = []
        for node in tree.nodes:
            parts = [held[part] for part in node.parts]
            held.append(np.sum(parts, axis=0) if parts else self.held[node.region])
        rooms = self.held.sum(axis=0)
        rows: list[tuple[FloatArray, float, float]] = []
        for mine, features in zip(held, tree.features, strict=True):
            if mine.sum() >= FEWEST:
                overlap = float((mine / (mine.sum() + rooms - mine)).max())
                rows.append((features, overlap if overlap > 0.5 else 0.0, 1.0))
        return as_samples(rows, len(room_features.FEATURES))
