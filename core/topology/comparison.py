"""Two models of one home held against each other: which nodes are the same, what they were made with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import linear_sum_assignment

from core.geometry import FloatArray, IntArray
from core.topology.model import Model

SAME = 0.1
"""Least intersection over union of two nodes that are called the same."""
NOT_PARAMETERS = ("inputs", "calibration", "closures", "scans", "sentences", "versions")
"""Parts of the provenance that are results or sources, not what somebody chose."""


@dataclass(frozen=True)
class MatchedNodes:
    """A node of the first model and the node of the second that covers the same floor.

    Attributes:
        first, second: node ids.
        overlap: intersection over union of their floors.
        moved: metres between their positions.
        area_change: square metres that the second has more.
    """

    first: str
    second: str
    overlap: float
    moved: float
    area_change: float


@dataclass(frozen=True)
class Comparison:
    """What two models have in common and where they differ.

    Attributes:
        nodes: matched one to one, the best first.
        only_first, only_second: ids of nodes without a partner.
        free_overlap: intersection over union of the free space of both maps.
        parameters: name -> (value in the first, value in the second) where they differ; None where
            a model has no such parameter.
    """

    nodes: tuple[MatchedNodes, ...]
    only_first: tuple[str, ...]
    only_second: tuple[str, ...]
    free_overlap: float
    parameters: Mapping[str, tuple[Any, Any]]


def compare(first: Model, second: Model) -> Comparison:
    """Compares two models in one frame, cell by cell of the first."""
    labels = _seen_from(first, second, second.regions)
    free = _seen_from(first, second, second.grid.free.astype(np.int64)) > 0
    pairs = _matched(first, second, labels)
    partnered = {p.first for p in pairs}, {p.second for p in pairs}
    both, either = _free_cells(first, second, free)
    return Comparison(
        pairs,
        tuple(n.id for n in first.topology.nodes if n.id not in partnered[0]),
        tuple(n.id for n in second.topology.nodes if n.id not in partnered[1]),
        both / either if either else 0.0,
        different_parameters(first.provenance, second.provenance),
    )


def different_parameters(
    first: Mapping[str, Any], second: Mapping[str, Any]
) -> dict[str, tuple[Any, Any]]:
    """Parameters of two provenances that differ, by dotted name in order."""
    one, two = _flat(first), _flat(second)
    names = sorted(one.keys() | two.keys())
    pairs = {name: (one.get(name), two.get(name)) for name in names}
    return {name: values for name, values in pairs.items() if values[0] != values[1]}


def _flat(value: Any, name: str = "") -> dict[str, Any]:
    if not isinstance(value, Mapping):
        return {name: value}
    out: dict[str, Any] = {}
    for key, inner in value.items():
        if key not in NOT_PARAMETERS:
            out |= _flat(inner, f"{name}.{key}" if name else str(key))
    return out


def _seen_from(first: Model, second: Model, image: IntArray) -> IntArray:
    """An image of the second model (its shape) on the first one's grid, 0 outside."""
    cells = np.argwhere(np.ones(first.grid.geometry.shape, bool))
    place = second.grid.geometry.cell_of(first.grid.geometry.world_of(cells))
    inside = second.grid.geometry.contains(place)
    seen = np.zeros(len(cells), np.int64)
    seen[inside] = image[place[inside, 0], place[inside, 1]]
    return seen.reshape(first.grid.geometry.shape)


def _free_cells(first: Model, second: Model, seen: np.ndarray) -> tuple[float, float]:
    """Square metres that are free in both maps, and in either."""
    unit = first.grid.geometry.cell_area
    both = float((first.grid.free & seen).sum()) * unit
    own = float(first.grid.free.sum()) * unit
    other = float(second.grid.free.sum()) * second.grid.geometry.cell_area
    return both, own + other - both


def _matched(first: Model, second: Model, labels: IntArray) -> tuple[MatchedNodes, ...]:
    nodes, others = first.topology.nodes, second.topology.nodes
    overlap = np.zeros((len(nodes), len(others)))
    unit, other_unit = first.grid.geometry.cell_area, second.grid.geometry.cell_area
    size = np.bincount(second.regions.ravel(), minlength=int(labels.max(initial=0)) + 1)
    for i, node in enumerate(nodes):
        inside = first.regions == node.region
        shared = np.bincount(labels[inside], minlength=len(size)) * unit
        own = float(inside.sum()) * unit
        for j, other in enumerate(others):
            common, there = float(shared[other.region]), float(size[other.region]) * other_unit
            overlap[i, j] = common / max(own + there - common, unit)
    rows, cols = linear_sum_assignment(-overlap)
    found = [_pair(first, second, i, j, overlap) for i, j in zip(rows, cols, strict=True)]
    return tuple(sorted((p for p in found if p.overlap >= SAME), key=lambda p: -p.overlap))


def _pair(first: Model, second: Model, i: int, j: int, overlap: FloatArray) -> MatchedNodes:
    a, b = first.topology.nodes[i], second.topology.nodes[j]
    moved = float(np.hypot(*np.subtract(b.position, a.position)))
    share = min(1.0, float(overlap[i, j]))
    return MatchedNodes(a.id, b.id, share, moved, b.area_m2 - a.area_m2)
