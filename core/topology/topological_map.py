"""The topological map: nodes (one per region), edges (one per stretch of contact), rooms."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Node:
    """A region of free space as a place.

    Attributes:
        id: opaque, never reused.
        region: its value in the label image of the regions.
        label: what a person calls it, or None.
        area_m2: free floor in square metres.
        position: world `(x, y)` of a free point deep inside the region.
        convexity: share of the region's pairs of points that do not see each other (0 = convex).
    """

    id: str
    region: int
    label: str | None
    area_m2: float
    position: tuple[float, float]
    convexity: float


@dataclass(frozen=True)
class Edge:
    """A stretch where two regions touch: where one passes (world x, y) and how wide it is (m)."""

    id: str
    source: str
    target: str
    doorway: tuple[float, float]
    width_m: float


@dataclass(frozen=True)
class Room:
    """A group of adjacent nodes: `room` is its value in the label image of the rooms."""

    id: str
    room: int
    label: str | None
    nodes: tuple[str, ...]


@dataclass(frozen=True)
class TopologicalMap:
    """Nodes, edges and rooms of one home."""

    nodes: tuple[Node, ...]
    edges: tuple[Edge, ...]
    rooms: tuple[Room, ...]
