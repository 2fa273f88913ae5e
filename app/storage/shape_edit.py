"""Edits of a model folder that change what its nodes and rooms are made of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from app.storage.model_files import Edit
from core.topology import Model, TopologicalMap
from core.topology.edits import merge_nodes, move_node, split_node
from core.topology.model_folder import read_model, store_edit


def merge(node_ids: Sequence[str]) -> Edit:
    """Makes touching nodes one."""

    def words(before: TopologicalMap) -> str:
        names = [before.node(node_id).name for node_id in dict.fromkeys(node_ids)]
        return f"merged {', '.join(names[:-1])} and {names[-1]}"

    return _edit(lambda model: merge_nodes(model, node_ids), words)


def split(node_id: str, line: Sequence[tuple[float, float]]) -> Edit:
    """Parts a node along a line of world points."""
    return _edit(
        lambda model: split_node(model, node_id, line),
        lambda before: f"split {before.node(node_id).name}",
    )


def move(node_id: str, room_id: str | None) -> Edit:
    """Puts a node into another room, with None into one of its own."""

    def words(before: TopologicalMap) -> str:
        name = before.node(node_id).name
        if room_id is None:
            return f"made {name} a room of its own"
        return f"moved {name} to {before.room(room_id).name}"

    return _edit(lambda model: move_node(model, node_id, room_id), words)


def _edit(change: Callable[[Model], Model], words: Callable[[TopologicalMap], str]) -> Edit:
    def edit(folder: Path) -> str:
        before = read_model(folder)
        store_edit(change(before), folder)
        return words(before.topology)

    return edit
