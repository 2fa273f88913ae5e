"""Merging draft cells into rooms: the border that is least likely a real one goes first."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray, IntArray
from core.segmentation.boundary_features import (
    RegionOutline,
    RegionShape,
    boundary_features,
    common_walls,
    region_shapes,
)
from core.segmentation.boundary_points import Pair, boundary_points
from core.segmentation.boundary_shape import BoundaryShape, Surroundings, boundary_shape

Judge = Callable[[list[Pair], FloatArray], FloatArray]
"""Log-odds (n,) that the borders of n pairs with these features (n, f) are real."""
Merged = Callable[[int, int], None]
"""Told `(kept, gone)` at each merger."""


@dataclass
class _Border:
    """A border: its points (n, 2) and what is around it."""

    points: FloatArray
    shape: BoundaryShape


class RegionGraph:
    """Regions and their borders while they merge; built once, merged by `merge`."""

    def __init__(self, cells: IntArray, around: Surroundings) -> None:
        self._around = around
        self.shapes: dict[int, RegionShape] = region_shapes(
            cells, around.clearance, around.bare, around.resolution
        )
        self.parent = np.arange(int(cells.max(initial=0)) + 1)
        self.borders: dict[int, dict[int, _Border]] = {value: {} for value in self.shapes}
        self._walls: dict[int, dict[int, float]] = {value: {} for value in self.shapes}
        for (a, b), points in boundary_points(cells).items():
            self.borders[a][b] = self.borders[b][a] = self._border(points)
        for (a, b), length in common_walls(cells, around.resolution).items():
            self._walls[a][b] = self._walls[b][a] = length

    def pairs(self) -> list[Pair]:
        """All pairs of regions that touch, in order."""
        return sorted((a, b) for a, others in self.borders.items() for b in others if a < b)

    def features(self, pair: Pair) -> list[float]:
        """What tells whether the border of a pair is real."""
        a, b = pair
        border = self.borders[a][b]
        return boundary_features(
            self.shapes[a],
            self.shapes[b],
            (self.outline(a), self.outline(b)),
            len(border.points),
            border.shape,
            self._walls[a].get(b, 0.0),
            self._around.character,
            self._around.resolution,
        )

    def outline(self, region: int) -> RegionOutline:
        """What bounds a region."""
        borders, resolution = self.borders[region], self._around.resolution
        return RegionOutline(
            sum(len(border.points) for border in borders.values()) * resolution,
            sum(self._walls[region].values()),
            len(borders),
        )

    def join(self, kept: int, gone: int) -> list[Pair]:
        """Makes two regions one; returns the pairs whose border has changed."""
        self.parent[self.parent == gone] = kept
        self.shapes[kept] = self.shapes[kept].joined(self.shapes.pop(gone), self._around.resolution)
        for other, border in self.borders.pop(gone).items():
            del self.borders[other][gone]
            if other == kept:
                continue
            if other in self.borders[kept]:
                mine = self.borders[kept][other]
                border = self._border(np.concatenate((mine.points, border.points)))
            self.borders[kept][other] = self.borders[other][kept] = border
        for other, length in self._walls.pop(gone).items():
            del self._walls[other][gone]
            if other != kept:
                length += self._walls[kept].get(other, 0.0)
                self._walls[kept][other] = self._walls[other][kept] = length
        return [(min(kept, other), max(kept, other)) for other in self.borders[kept]]

    def _border(self, points: FloatArray) -> _Border:
        return _Border(points, boundary_shape(points, self._around))


def merge(
    graph: RegionGraph, judge: Judge, least: float, merged: Merged | None = None
) -> dict[Pair, float]:
    """Merges until every border that is left is real.

    Args:
        graph: changed in place; `graph.parent` tells the region of each draft cell afterwards.
        judge: log-odds of borders.
        least: log-odds that a border needs to stay.
        merged: told of every merger.

    Returns:
        Log-odds of the borders that stayed.
    """
    odds = _judged(graph, graph.pairs(), judge)
    waiting = [(value, pair) for pair, value in odds.items()]
    heapq.heapify(waiting)
    while waiting:
        value, pair = heapq.heappop(waiting)
        if odds.get(pair) != value:
            continue  # judged again since, or gone
        if value >= least:
            break
        kept, gone = pair
        for other in graph.borders[gone]:
            del odds[min(gone, other), max(gone, other)]
        if merged is not None:
            merged(kept, gone)
        fresh = _judged(graph, graph.join(kept, gone), judge)
        odds |= fresh
        for again, value in fresh.items():
            heapq.heappush(waiting, (value, again))
    return odds


def _judged(graph: RegionGraph, pairs: list[Pair], judge: Judge) -> dict[Pair, float]:
    if not pairs:
        return {}
    values = judge(pairs, np.array([graph.features(pair) for pair in pairs]))
    return {pair: float(value) for pair, value in zip(pairs, values, strict=True)}
