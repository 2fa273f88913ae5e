"""A model made again of the same home (a longer drive, better poses): who is who, by overlap.

Every node that was there keeps its id, its number and its name, wherever its region ends now; so do
rooms and doorways. Ids that are gone are never given again. `came_from` says what a node was cut from or
joined of since the earlier model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from core.geometry import IntArray
from core.mapping import GridGeometry
from core.topology.labels import carried_labels, room_image, with_rooms
from core.topology.model import Model
from core.topology.region_cells import region_cells
from core.topology.renumbering import renumbered
from core.topology.topological_map import Edge, Node, TopologicalMap

LEAST_SHARE = 0.3
"""Share of the smaller of two regions that lies in the other one when they are taken for kin."""
SAME_DOORWAY = 0.5
"""Metres by which a doorway may move between two models."""


def going_on(model: Model, earlier: Model) -> Model:
    """A model that was made again, with the ids, numbers, names and rooms of the earlier one."""
    topology = continued(model.topology, model.regions, model.grid.geometry, earlier)
    model = renumbered(replace(model, topology=topology), earlier.topology)
    return replace(model, rooms=room_image(model.regions, model.topology))


def continued(
    topology: TopologicalMap, regions: IntArray, geometry: GridGeometry, earlier: Model
) -> TopologicalMap:
    """The topology of a new model with the ids, names and rooms of an earlier one.

    Args:
        topology: of the new model.
        regions: (rows, cols) its regions.
        geometry: where their cells lie.
        earlier: the model of the same home before.
    """
    shared = _shared(earlier, regions, geometry)
    ids = _matched(shared)
    number = max(topology.next_number, earlier.topology.next_number)
    for node in topology.nodes:
        if node.region not in ids:
            ids[node.region] = f"n{number}"
            number += 1
    labels = carried_labels(
        earlier.topology, earlier.regions, earlier.grid.geometry, regions, geometry
    )
    nodes = tuple(
        replace(
            node,
            id=ids[node.region],
            label=labels.get(node.region, node.label),
            came_from=_came_from(node, ids[node.region], shared, earlier.topology),
        )
        for node in topology.nodes
    )
    now = {node.id: ids[node.region] for node in topology.nodes}
    edges, number = _edges(topology.edges, now, earlier.topology.edges, number)
    return with_rooms(TopologicalMap(nodes, edges, earlier.topology.rooms, number))


def _shared(
    earlier: Model, regions: IntArray, geometry: GridGeometry
) -> dict[tuple[str, int], float]:
    """Share of the smaller one that earlier nodes and new regions have in common, where it counts."""
    area = np.bincount(regions.ravel())
    found = {}
    nodes = earlier.topology.nodes
    before = region_cells(earlier.regions, (node.region for node in nodes))
    for node, mine in zip(nodes, before, strict=True):
        world = earlier.grid.geometry.world_of(mine)
        cells = geometry.cell_of(world)
        cells = cells[geometry.contains(cells)]
        hit = np.bincount(regions[cells[:, 0], cells[:, 1]], minlength=len(area))
        hit[0] = 0
        for region in np.flatnonzero(hit):
            share = float(hit[region]) / max(1, min(len(world), int(area[region])))
            if share >= LEAST_SHARE:
                found[node.id, int(region)] = share * float(hit[region])
    return found


def _matched(shared: Mapping[tuple[str, int], float]) -> dict[int, str]:
    """The node that each region goes on from; the pair with most in common first, each once."""
    ids: dict[int, str] = {}
    taken = set()
    for node_id, region in sorted(shared, key=lambda pair: (-shared[pair], pair)):
        if region not in ids and node_id not in taken:
            ids[region] = node_id
            taken.add(node_id)
    return ids


def _came_from(
    node: Node,
    node_id: str,
    shared: Mapping[tuple[str, int], float],
    earlier: TopologicalMap,
) -> tuple[str, ...]:
    """Earlier nodes that are in a node now, when that is not simply what it was."""
    kin = tuple(
        old.id for old in earlier.nodes if (old.id, node.region) in shared and old.id != node_id
    )
    before = next((old.came_from for old in earlier.nodes if old.id == node_id), ())
    return tuple(dict.fromkeys((*before, *kin)))


def _edges(
    edges: tuple[Edge, ...], now: Mapping[str, str], earlier: tuple[Edge, ...], number: int
) -> tuple[tuple[Edge, ...], int]:
    """The edges between the nodes as they are called now, and the next number."""
    waiting = list(earlier)
    found = []
    for edge in edges:
        source, target = now[edge.source], now[edge.target]
        same = [old for old in waiting if _is_same(old, edge, {source, target})]
        if same:
            edge_id = min(same, key=lambda old: _moved(old, edge)).id
            waiting = [old for old in waiting if old.id != edge_id]
        else:
            edge_id, number = f"e{number}", number + 1
        found.append(replace(edge, id=edge_id, source=source, target=target))
    return tuple(found), number


def _is_same(old: Edge, edge: Edge, ends: set[str]) -> bool:
    return {old.source, old.target} == ends and _moved(old, edge) <= SAME_DOORWAY


def _moved(old: Edge, edge: Edge) -> float:
    return float(np.hypot(*np.subtract(old.doorway, edge.doorway)))
