"""Edits of a model by a person: merging nodes, splitting one, moving one to another room.

Decisions:
- A merged node keeps the id, region and suggested room of its largest part, and that part's label
  or, when it has none, the label of the largest part that has one.
- Of a split node the larger piece keeps id and region; both pieces keep its label and its suggested
  room, so that they stay one room until somebody says otherwise.
- `came_from` names the earlier nodes of a merge or split. No id is ever given twice.
- A node moved to a room takes the room's name. A room without a name takes the name of a node that
  was the whole of its own room, so that no name is lost. A node that leaves a room leaves its name.
- Whatever is not touched keeps its ids, names and places. The floor of all regions stays the same.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from core.errors import InputError, ModelError
from core.geometry import BoolArray, IntArray
from core.segmentation.connected import border_lengths
from core.topology.changed_regions import with_changed_regions
from core.topology.cut_line import CutConfig, cut_region
from core.topology.labels import room_image, with_rooms
from core.topology.model import Model
from core.topology.topological_map import Node, Room, TopologicalMap
from core.topology.topology_of import measured_node


@dataclass(frozen=True)
class EditConfig:
    """Limits of edits."""

    cut: CutConfig = field(default_factory=CutConfig)


def merge_nodes(model: Model, node_ids: Sequence[str]) -> Model:
    """The model with two or more touching nodes as one.

    Raises:
        InputError: fewer than two different nodes.
        ModelError: there is no such node, or they do not all touch.
    """
    parts = sorted(
        (model.topology.node(node_id) for node_id in dict.fromkeys(node_ids)),
        key=lambda node: -node.area_m2,
    )
    if len(parts) < 2:
        raise InputError("nodes: choose at least two different nodes to merge")
    _check_touching(parts, model.regions)
    kept = parts[0]
    mask = np.isin(model.regions, [node.region for node in parts])
    regions = np.where(mask, kept.region, model.regions)
    label = next((node.label for node in parts if node.label is not None), None)
    merged = replace(
        measured_node(model.grid, mask, kept.id, kept.region, label, kept.suggested_room),
        came_from=_ancestors(parts),
    )
    gone = {node.id for node in parts[1:]}
    nodes = tuple(
        merged if node.id == kept.id else node
        for node in model.topology.nodes
        if node.id not in gone
    )
    entry = {"op": "merge", "nodes": [node.id for node in parts], "node": kept.id}
    return _edited(model, model.topology, nodes, regions, {kept.id}, entry)


def split_node(
    model: Model, node_id: str, line: npt.ArrayLike, config: EditConfig | None = None
) -> Model:
    """The model with one node as two, parted along a line of world points (n, 2).

    Ends inside the region are drawn on to its border where that is near.

    Raises:
        InputError: the line is none.
        ModelError: there is no such node, or the line does not part it in two; it says why.
    """
    config = config or EditConfig()
    topology = model.topology
    node = topology.node(node_id)
    points = np.asarray(line, float)
    region: BoolArray = model.regions == node.region
    smaller = cut_region(region, model.grid.geometry, points, node.name, config.cut)
    value = int(model.regions.max()) + 1
    new_id = f"n{topology.next_number}"
    came_from = _ancestors([node])
    pieces = (
        measured_node(
            model.grid, region & ~smaller, node.id, node.region, node.label, node.suggested_room
        ),
        measured_node(model.grid, smaller, new_id, value, node.label, node.suggested_room),
    )
    larger_piece, smaller_piece = (replace(piece, came_from=came_from) for piece in pieces)
    nodes = tuple(larger_piece if old.id == node.id else old for old in topology.nodes)
    entry = {"op": "split", "node": node.id, "new": new_id, "line": points.tolist()}
    return _edited(
        model,
        replace(topology, next_number=topology.next_number + 1),
        (*nodes, smaller_piece),
        np.where(smaller, value, model.regions),
        {node.id, new_id},
        entry,
    )


def move_node(model: Model, node_id: str, room_id: str | None) -> Model:
    """The model with one node in another room, or with None in a room of its own.

    Raises:
        ModelError: there is no such node or room, the node is there already, or does not touch it.
    """
    topology = model.topology
    node = topology.node(node_id)
    own = next(room for room in topology.rooms if node.id in room.nodes)
    if room_id is None:
        moved = _alone(topology, node, own)
    else:
        moved = _joined(topology, node, own, topology.room(room_id))
    topology = with_rooms(moved)
    entry = {"op": "move", "node": node.id, "room": room_id}
    return replace(
        model,
        topology=topology,
        rooms=room_image(model.regions, topology),
        history=(*model.history, {"event": "edit", **entry}),
    )


def _alone(topology: TopologicalMap, node: Node, own: Room) -> TopologicalMap:
    if own.nodes == (node.id,):
        raise ModelError(f"{node.name} is a room of its own already")
    number = max(other.suggested_room for other in topology.nodes) + 1
    return _with_nodes(topology, [replace(node, label=None, suggested_room=number)])


def _joined(topology: TopologicalMap, node: Node, own: Room, room: Room) -> TopologicalMap:
    if own.id == room.id:
        raise ModelError(f"{node.name} is in {room.name} already")
    beside = _widest_neighbour(topology, node, room)
    label, named = room.label, list[Node]()
    if label is None and own.nodes == (node.id,):
        label = node.label
        named = [replace(topology.node(member), label=label) for member in room.nodes]
    moved = replace(node, label=label, suggested_room=beside.suggested_room)
    members = {own.id: tuple(n for n in own.nodes if n != node.id)}
    members[room.id] = (*room.nodes, node.id)
    rooms = tuple(replace(old, nodes=members.get(old.id, old.nodes)) for old in topology.rooms)
    return _with_nodes(replace(topology, rooms=rooms), [moved, *named])


def _widest_neighbour(topology: TopologicalMap, node: Node, room: Room) -> Node:
    """The node of a room that shares the widest contact with a node.

    Raises:
        ModelError: none of them touches it.
    """
    widths = {
        other: edge.width_m
        for edge in sorted(topology.edges, key=lambda edge: edge.width_m)
        for one, other in ((edge.source, edge.target), (edge.target, edge.source))
        if one == node.id and other in room.nodes
    }
    if not widths:
        raise ModelError(
            f"{node.name} does not touch {room.name}: a room is a group of touching regions"
        )
    return topology.node(max(widths, key=lambda other: widths[other]))


def _check_touching(parts: Sequence[Node], regions: IntArray) -> None:
    """Raises a ModelError that names a node which none of the others leads to."""
    values = [node.region for node in parts]
    only = np.where(np.isin(regions, values), regions, 0)
    borders = border_lengths(only)
    reached, last = {values[0]}, 0
    while len(reached) > last:
        last = len(reached)
        reached |= {end for pair in borders if reached & set(pair) for end in pair}
    for node in parts:
        if node.region not in reached:
            others = " or ".join(other.name for other in parts if other.region in reached)
            raise ModelError(
                f"{node.name} does not touch {others}: only regions that touch can be merged"
            )


def _ancestors(parts: Iterable[Node]) -> tuple[str, ...]:
    """The ids of nodes and of what they came from, each once."""
    return tuple(dict.fromkeys(i for node in parts for i in (node.id, *node.came_from)))


def _with_nodes(topology: TopologicalMap, changed: Iterable[Node]) -> TopologicalMap:
    by_id = {node.id: node for node in changed}
    return replace(topology, nodes=tuple(by_id.get(node.id, node) for node in topology.nodes))


def _edited(
    model: Model,
    topology: TopologicalMap,
    nodes: Sequence[Node],
    regions: IntArray,
    changed: set[str],
    entry: Mapping[str, Any],
) -> Model:
    topology = with_changed_regions(topology, nodes, regions, model.grid.geometry, changed)
    return replace(
        model,
        regions=regions,
        rooms=room_image(regions, topology),
        topology=topology,
        history=(*model.history, {"event": "edit", **entry}),
    )
