"""The topological map after some regions were given another shape: the rest stays as it was."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from core.geometry import IntArray
from core.mapping import GridGeometry
from core.topology.contacts import contacts
from core.topology.labels import with_rooms
from core.topology.topological_map import Edge, Node, TopologicalMap
from core.topology.topology_of import measured_edge


def with_changed_regions(
    topology: TopologicalMap,
    nodes: Sequence[Node],
    regions: IntArray,
    geometry: GridGeometry,
    changed: Collection[str],
) -> TopologicalMap:
    """The map with other nodes, its edges and rooms brought up to date.

    An edge between untouched nodes stays. A stretch of contact of a changed node that is where it
    was, and as wide, keeps its id, whichever node it leads to now.

    Args:
        topology: the map before; its `next_number` is already past the ids of `nodes`.
        nodes: the nodes now.
        regions: (rows, cols) the regions now.
        changed: ids of the nodes among them that have another region than before.
    """
    ids = {node.region: node.id for node in nodes}
    still = {node.id for node in nodes} - set(changed)
    kept = [edge for edge in topology.edges if still >= {edge.source, edge.target}]
    loose = {
        _place(edge): edge.id for edge in topology.edges if not still >= {edge.source, edge.target}
    }
    number = topology.next_number
    for contact in contacts(regions, geometry):
        if ids[contact.low] in still and ids[contact.high] in still:
            continue
        edge = measured_edge(contact, "", ids)
        edge_id = loose.pop(_place(edge), None)
        if edge_id is None:
            edge_id = f"e{number}"
            number += 1
        kept.append(replace(edge, id=edge_id))
    return with_rooms(replace(topology, nodes=tuple(nodes), edges=tuple(kept), next_number=number))


def _place(edge: Edge) -> tuple[tuple[float, float], float]:
    return edge.doorway, edge.width_m
