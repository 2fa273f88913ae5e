"""Features of a region, from which the room model tells how good a room it would make."""

from __future__ import annotations

import math

import numpy as np

from core.geometry import FloatArray
from core.segmentation.boundary_features import FEWEST_SPECKS, LEAST_FURNITURE, SMALL
from core.segmentation.merging import RegionGraph

FEATURES = (
    "area (log m2)",
    "largest disc (log m)",
    "largest bare disc (log m)",
    "solidity",
    "area / largest disc (log)",
    "share of its rectangle along the main walls",
    "long side of that / short side (log)",
    "short side (log m)",
    "open share of the outline",
    "open outline / sqrt(area) (log)",
    "log-odds of the border that it was joined across",
    "greatest log-odds of all borders inside",
    "least log-odds of its borders",
    "greatest log-odds of its borders",
    "mean probability of its borders, by length",
    "length of its borders that are not real / sqrt(area)",
    "widest passage / largest disc (log)",
    "floor of the map (log m2)",
    "specks of the map (log per m2)",
    "furniture of the map (log share of the floor)",
)
NOTHING = -9.0
"""Log-odds where there is no border inside."""
NO_NEIGHBOUR = 5.0
"""Log-odds of the outline of a region without neighbours."""
LEAST_AREA = 0.01
"""Square metres of the smallest disc."""


def room_features(graph: RegionGraph, region: int, joined: float, inside: float) -> list[float]:
    """The numbers that `FEATURES` names.

    Args:
        graph: whose borders have been judged.
        region: one of its regions.
        joined: log-odds of the border that it was joined across last, `NOTHING` for a draft cell.
        inside: the greatest of all such log-odds inside it.
    """
    log, resolution = math.log, graph.around.resolution
    shape, outline, character = graph.shapes[region], graph.outline(region), graph.around.character
    short, long = _sides(shape.hull, graph.around.axis, resolution)
    odds, length, passage = _borders(graph, region)
    real = 1 / (1 + np.exp(-odds))
    root = math.sqrt(shape.area)
    return [
        log(shape.area),
        log(shape.depth + SMALL),
        log(shape.bare + SMALL),
        shape.area / shape.hull_area,
        log(shape.area / (4 * shape.depth**2 + LEAST_AREA)),
        shape.area / (short * long),
        log(long / short),
        log(short),
        outline.open_share,
        log((outline.open + SMALL) / root),
        joined,
        inside,
        float(odds.min()),
        float(odds.max()),
        float((real * length).sum() / length.sum()),
        float(((1 - real) * length).sum()) * resolution / root,
        log((passage + SMALL) / (2 * shape.depth)),
        log(character.area),
        log(character.specks + FEWEST_SPECKS),
        log(character.furniture + LEAST_FURNITURE),
    ]


def _sides(hull: FloatArray, axis: float, resolution: float) -> tuple[float, float]:
    """Short and long side (m) of the rectangle along the main walls around a hull (n, 2)."""
    cos, sin = math.cos(axis), math.sin(axis)
    along, across = hull[:, 1] * cos + hull[:, 0] * sin, hull[:, 0] * cos - hull[:, 1] * sin
    sides = (np.ptp(along) + 1) * resolution, (np.ptp(across) + 1) * resolution
    return float(min(sides)), float(max(sides))


def _borders(graph: RegionGraph, region: int) -> tuple[FloatArray, FloatArray, float]:
    """Log-odds and lengths (points) of a region's borders and the widest passage (m)."""
    borders = graph.borders[region].values()
    if not borders:
        return np.array([NO_NEIGHBOUR]), np.ones(1), SMALL
    return (
        np.array([border.log_odds for border in borders]),
        np.array([len(border.points) for border in borders], float),
        max(border.shape.passage for border in borders),
    )
