"""The topological map: nodes (one per region), edges (one per stretch of contact), rooms."""

from __future__ import annotations

from dataclasses import dataclass

from core.errors import ModelError


@dataclass(frozen=True)
class Node:
    """A region of free space as a place.

    Attributes:
        id: opaque, never reused.
        region: its value in the label image of the regions.
        label: what a person calls it, or None.
        area_m2: free floor in square metres.
        position: world `(x, y)` of a free point deep inside the region.
        convexity: share of the region's pairs of points that an obstacle hides from each other (0 =
            convex).
        suggested_room: number of the group of nodes that the program takes for one room.
        came_from: ids of all earlier nodes that a merge or split made it from, its own id among
            them when it had another shape under it; empty when it is as the modeller cut it.
    """

    id: str
    region: int
    label: str | None
    area_m2: float
    position: tuple[float, float]
    convexity: float
    suggested_room: int = 0
    came_from: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """What a message calls it: its label, else the number of its region."""
        return self.label or f"Region {self.region}"


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

    @property
    def name(self) -> str:
        """What a message calls it: its label, else its number."""
        return self.label or f"room {self.room}"


@dataclass(frozen=True)
class TopologicalMap:
    """Nodes, edges and rooms of one home; `next_number` is the first one that no id has used."""

    nodes: tuple[Node, ...]
    edges: tuple[Edge, ...]
    rooms: tuple[Room, ...]
    next_number: int = 1

    def node(self, node_id: str) -> Node:
        """The node with an id.

        Raises:
            ModelError: there is none.
        """
        for node in self.nodes:
            if node.id == node_id:
                return node
        raise ModelError(f"there is no node {node_id!r} in this model")

    def room(self, room_id: str) -> Room:
        """The room with an id.

        Raises:
            ModelError: there is none.
        """
        for room in self.rooms:
            if room.id == room_id:
                return room
        raise ModelError(f"there is no room {room_id!r} in this model")
