"""Names: giving them, what they do to rooms, and carrying them to a new model of the same home.

A room is a group of touching nodes. The program suggests groups; a label given to a node takes it
out of its suggested group and joins it with the touching nodes of the same label. Taking the label
away brings the suggestion back. Two separate bedrooms stay two rooms.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.errors import InputError
from core.geometry import IntArray
from core.mapping import GridGeometry
from core.topology.region_cells import region_cells
from core.topology.topological_map import Node, Room, TopologicalMap
from core.wording import is_printable

MAX_LABEL = 80
"""Characters of the longest label."""
CARRY_OVERLAP = 0.3
"""Share of the old region that must lie in the new one for its label to go along."""


def clean_label(label: str | None) -> str | None:
    """A label as it is stored: trimmed, None when nothing is left.

    Raises:
        InputError: it is too long or holds control characters.
    """
    text = (label or "").strip()
    if not text:
        return None
    if len(text) > MAX_LABEL:
        raise InputError(f"a label has at most {MAX_LABEL} characters, this one has {len(text)}")
    if not is_printable(text):
        raise InputError("a label must not hold control characters or line breaks")
    return text


def label_node(topology: TopologicalMap, node_id: str, label: str | None) -> TopologicalMap:
    """The map with one node named; None takes its name away.

    Raises:
        ModelError: there is no such node.
        InputError: the label cannot be one.
    """
    return _label(topology, {topology.node(node_id).id}, clean_label(label))


def label_room(topology: TopologicalMap, room_id: str, label: str | None) -> TopologicalMap:
    """The map with all nodes of a room named.

    Raises:
        ModelError: there is no such room.
        InputError: the label cannot be one.
    """
    return _label(topology, set(topology.room(room_id).nodes), clean_label(label))


def _label(topology: TopologicalMap, node_ids: set[str], label: str | None) -> TopologicalMap:
    nodes = tuple(
        replace(node, label=label) if node.id in node_ids else node for node in topology.nodes
    )
    return with_rooms(replace(topology, nodes=nodes))


def with_rooms(topology: TopologicalMap) -> TopologicalMap:
    """The map with its rooms grouped anew; a room keeps its id where most of its nodes stay."""
    groups = _groups(topology)
    ids, next_number = _room_ids(groups, topology)
    label_of = {node.id: node.label for node in topology.nodes}
    rooms = tuple(
        Room(room_id, i + 1, label_of[group[0]], group)
        for i, (room_id, group) in enumerate(zip(ids, groups, strict=True))
    )
    return replace(topology, rooms=rooms, next_number=next_number)


def _groups(topology: TopologicalMap) -> list[tuple[str, ...]]:
    """Touching nodes with the same label, or of the same suggested room when without a label."""
    node_of = {node.id: node for node in topology.nodes}
    parent = {node.id: node.id for node in topology.nodes}

    def root(node_id: str) -> str:
        while parent[node_id] != node_id:
            node_id = parent[node_id]
        return node_id

    for edge in topology.edges:
        if _one_room(node_of[edge.source], node_of[edge.target]):
            parent[root(edge.target)] = root(edge.source)
    groups: dict[str, list[str]] = {}
    for node in topology.nodes:
        groups.setdefault(root(node.id), []).append(node.id)
    return [tuple(group) for group in groups.values()]


def _one_room(a: Node, b: Node) -> bool:
    if a.label is None and b.label is None:
        return a.suggested_room == b.suggested_room
    return a.label == b.label


def _room_ids(groups: list[tuple[str, ...]], topology: TopologicalMap) -> tuple[list[str], int]:
    """An id for each group: the old room's that shares most nodes, or a new one."""
    shared = sorted(
        (
            (-len(set(group) & set(room.nodes)), i, room.id)
            for i, group in enumerate(groups)
            for room in topology.rooms
            if set(group) & set(room.nodes)
        ),
    )
    ids: dict[int, str] = {}
    for _, i, room_id in shared:
        if i not in ids and room_id not in ids.values():
            ids[i] = room_id
    number = topology.next_number
    for i in range(len(groups)):
        if i not in ids:
            ids[i] = f"r{number}"
            number += 1
    return [ids[i] for i in range(len(groups))], number


def room_image(regions: IntArray, topology: TopologicalMap) -> IntArray:
    """The label image (rows, cols) of the rooms."""
    region_of = {node.id: node.region for node in topology.nodes}
    table = np.zeros(int(regions.max(initial=0)) + 1, np.int64)
    for room in topology.rooms:
        for node_id in room.nodes:
            table[region_of[node_id]] = room.room
    return np.asarray(table[regions])


def carried_labels(
    old: TopologicalMap,
    old_regions: IntArray,
    old_geometry: GridGeometry,
    new_regions: IntArray,
    new_geometry: GridGeometry,
) -> dict[int, str]:
    """Labels of an earlier model for the regions of a new one, by overlap in the world.

    Returns:
        Label of each new region that covers enough of a labelled old one; when several do, that of
        the largest overlap.
    """
    best: dict[int, tuple[int, str]] = {}
    labelled = [(node.region, node.label) for node in old.nodes if node.label is not None]
    before = region_cells(old_regions, (region for region, _ in labelled))
    for (_, label), mine in zip(labelled, before, strict=True):
        world = old_geometry.world_of(mine)
        cells = new_geometry.cell_of(world)
        cells = cells[new_geometry.contains(cells)]
        hit = np.bincount(new_regions[cells[:, 0], cells[:, 1]], minlength=1)
        hit[0] = 0
        for region in np.flatnonzero(hit >= CARRY_OVERLAP * max(1, len(world))):
            if int(hit[region]) > best.get(int(region), (0, ""))[0]:
                best[int(region)] = (int(hit[region]), label)
    return {region: label for region, (_, label) in best.items()}
