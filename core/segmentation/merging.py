"""Merging regions: the border that is least likely a real one goes first."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from copy import copy
from dataclasses import dataclass
from math import nan

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
Merged = Callable[[int, int, float], None]
"""Told `(kept, gone, log-odds of their border)` after each merger."""


@dataclass
class Border:
    """A border.

    Attributes:
        points: (n, 2) middles `[row, col]` between the cells of both sides.
        shape: what is around it.
        log_odds: that it is real, as judged last.
    """

    points: FloatArray
    shape: BoundaryShape
    log_odds: float = nan


class RegionGraph:
    """Regions and their borders while they merge; built once, merged by `merge`."""

    def __init__(self, cells: IntArray, around: Surroundings) -> None:
        self.around = around
        self.shapes: dict[int, RegionShape] = region_shapes(
            cells, around.clearance, around.bare, around.resolution
        )
        self.parent = np.arange(int(cells.max(initial=0)) + 1)
        self.borders: dict[int, dict[int, Border]] = {value: {} for value in self.shapes}
        self._walls: dict[int, dict[int, float]] = {value: {} for value in self.shapes}
        self._outlines: dict[int, RegionOutline] = {}
        touching = boundary_points(cells)
        for (a, b), points in touching.items():
            self.borders[a][b] = self.borders[b][a] = self._border(points)
        for (a, b), length in common_walls(cells, touching, around.resolution).items():
            self._walls[a][b] = self._walls[b][a] = length

    def copy(self) -> RegionGraph:
        """The same graph, to be merged on its own."""
        twin = copy(self)
        twin.shapes, twin.parent = dict(self.shapes), self.parent.copy()
        twin.borders = {value: dict(others) for value, others in self.borders.items()}
        twin._walls = {value: dict(others) for value, others in self._walls.items()}
        twin._outlines = dict(self._outlines)
        return twin

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
            self.around.character,
            self.around.resolution,
        )

    def outline(self, region: int) -> RegionOutline:
        """What bounds a region; measured again only when that has changed, as it is asked often."""
        if region not in self._outlines:
            borders, resolution = self.borders[region], self.around.resolution
            self._outlines[region] = RegionOutline(
                sum(len(border.points) for border in borders.values()) * resolution,
                sum(self._walls[region].values()),
                len(borders),
            )
        return self._outlines[region]

    def join(self, kept: int, gone: int) -> list[Pair]:
        """Makes two regions one; returns the pairs whose border has changed."""
        self.parent[self.parent == gone] = kept
        for changed in (kept, gone, *self.borders[gone], *self._walls[gone]):
            self._outlines.pop(changed, None)
        self.shapes[kept] = self.shapes[kept].joined(self.shapes.pop(gone), self.around.resolution)
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

    def _border(self, points: FloatArray) -> Border:
        return Border(points, boundary_shape(points, self.around))


def merge(graph: RegionGraph, judge: Judge, least: float, merged: Merged | None = None) -> None:
    """Merges until every border that is left is real; `graph.borders` tells how likely each is.

    Args:
        graph: changed in place; its borders have been judged. `graph.parent` tells the region of
            each draft cell afterwards.
        judge: log-odds of borders.
        least: log-odds that a border needs to stay; infinite merges all that touch.
        merged: told of every merger.
    """
    waiting = [(graph.borders[a][b].log_odds, (a, b)) for a, b in graph.pairs()]
    heapq.heapify(waiting)
    while waiting:
        value, (kept, gone) = heapq.heappop(waiting)
        border = graph.borders.get(kept, {}).get(gone)
        if border is None or border.log_odds != value:
            continue  # judged again since, or gone
        if value >= least:
            break
        for changed in judged(graph, graph.join(kept, gone), judge):
            heapq.heappush(waiting, changed)
        if merged is not None:
            merged(kept, gone, value)


def judged(graph: RegionGraph, pairs: list[Pair], judge: Judge) -> list[tuple[float, Pair]]:
    """Judges borders; the log-odds of each, which its border keeps."""
    if not pairs:
        return []
    values = judge(pairs, np.array([graph.features(pair) for pair in pairs]))
    for (a, b), value in zip(pairs, values, strict=True):
        graph.borders[a][b].log_odds = float(value)
    return [(float(value), pair) for value, pair in zip(values, pairs, strict=True)]
