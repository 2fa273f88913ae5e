"""Edits of a model folder that give names."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from app.errors import NotFound
from app.storage.model_files import Edit
from core.topology.continuation import going_on
from core.topology.labels import carried_labels, label_node, label_room, with_rooms
from core.topology.model_folder import read_model, read_topology, store_edit, store_labels


def node_label(node_id: str, label: str | None) -> Edit:
    """Names a node; None takes its name away. The edit raises NotFound without such a node."""

    def edit(folder: Path) -> str:
        topology = read_topology(folder)
        if node_id not in {node.id for node in topology.nodes}:
            raise NotFound("node", node_id)
        store_labels(label_node(topology, node_id, label), folder)
        return _what(topology.node(node_id).name, label)

    return edit


def room_label(room_id: str, label: str | None) -> Edit:
    """Names all nodes of a room. The edit raises NotFound without such a room."""

    def edit(folder: Path) -> str:
        topology = read_topology(folder)
        if room_id not in {room.id for room in topology.rooms}:
            raise NotFound("room", room_id)
        store_labels(label_room(topology, room_id, label), folder)
        return _what(topology.room(room_id).name, label)

    return edit


def _what(before: str, label: str | None) -> str:
    """What was done, in words."""
    return f"took the name of {before} away" if label is None else f"named {before} “{label}”"


def carry_labels(earlier: Path, later: Path) -> None:
    """Gives the regions of a model the labels of an earlier model of the same home, by overlap."""
    old, new = read_model(earlier), read_model(later)
    labels = carried_labels(
        old.topology, old.regions, old.grid.geometry, new.regions, new.grid.geometry
    )
    if labels:
        nodes = tuple(
            replace(node, label=labels.get(node.region, node.label)) for node in new.topology.nodes
        )
        store_labels(with_rooms(replace(new.topology, nodes=nodes)), later)


def carry_identity(earlier: Path, later: Path) -> None:
    """Gives a model that was made again the ids, numbers, names and rooms that it had, by overlap."""
    store_edit(going_on(read_model(later), read_model(earlier)), later)
