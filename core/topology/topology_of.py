"""From regions to a topological map."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import OCCUPIED
from core.segmentation.hidden_pairs import hidden_pairs
from core.topology.contacts import Contact, contacts
from core.topology.labels import with_rooms
from core.topology.topological_map import Edge, Node, TopologicalMap


def topology_of(
    grid: OccupancyGrid,
    regions: IntArray,
    rooms: IntArray | None = None,
    labels: Mapping[int, str] | None = None,
    node_ids: Mapping[int, str] | None = None,
    next_number: int = 1,
    came_from: Mapping[int, tuple[str, ...]] | None = None,
) -> TopologicalMap:
    """Nodes, edges and rooms of a grid that is divided into regions.

    Args:
        grid: the map.
        regions: (rows, cols) label image, 0 = none.
        rooms: (rows, cols) label image of suggested rooms; by default every region is one.
        labels: label of each region that has one.
        node_ids: ids of regions that have one already; the others get new ones.
        next_number: the first number that no id has used.
        came_from: earlier nodes that a region was cut from or joined of.
    """
    labels, ids = labels or {}, dict(node_ids or {})
    number = next_number
    boxes = ndimage.find_objects(regions)
    values = [value for value, box in enumerate(boxes, start=1) if box is not None]
    for value in values:
        if value not in ids:
            ids[value] = f"n{number}"
            number += 1
    nodes = []
    for value in values:
        box = boxes[value - 1]
        mask = regions[box] == value
        room = int(np.bincount(rooms[box][mask]).argmax()) if rooms is not None else value
        corner = box[0].start, box[1].start
        node = measured_node(grid, mask, ids[value], value, labels.get(value), room, corner)
        nodes.append(replace(node, came_from=(came_from or {}).get(value, ())))
    edges = []
    for contact in contacts(regions, grid.geometry):
        edges.append(measured_edge(contact, f"e{number}", ids))
        number += 1
    return with_rooms(TopologicalMap(tuple(nodes), tuple(edges), (), number))


def measured_node(
    grid: OccupancyGrid,
    mask: BoolArray,
    node_id: str,
    region: int,
    label: str | None,
    suggested_room: int,
    corner: tuple[int, int] = (0, 0),
) -> Node:
    """A node with what is measured of its region.

    Args:
        grid: the map.
        mask: (rows, cols) the region within a part of the map.
        node_id, region, label, suggested_room: of the node.
        corner: `[row, col]` of the part's lowest cell.
    """
    row, col = corner
    blocked = grid.state[row : row + mask.shape[0], col : col + mask.shape[1]] == OCCUPIED
    return Node(
        node_id,
        region,
        label,
        round(float(mask.sum()) * grid.geometry.cell_area, 3),
        _deepest_point(grid, mask, corner),
        round(hidden_pairs(mask, blocked), 3),
        suggested_room,
    )


def measured_edge(contact: Contact, edge_id: str, ids: Mapping[int, str]) -> Edge:
    """The edge of a stretch of contact; `ids` are the node ids by region."""
    x, y = contact.middle
    ends = ids[contact.low], ids[contact.high]
    return Edge(edge_id, *ends, (round(x, 3), round(y, 3)), round(contact.width_m, 3))


def _deepest_point(
    grid: OccupancyGrid, mask: BoolArray, corner: tuple[int, int]
) -> tuple[float, float]:
    """World position of the point of a region that is farthest from its border."""
    rows, cols = np.nonzero(mask)
    low, high = (rows.min(), cols.min()), (rows.max() + 1, cols.max() + 1)
    part = np.pad(mask[low[0] : high[0], low[1] : high[1]], 1)
    depth = ndimage.distance_transform_edt(part)
    row, col = np.unravel_index(int(depth.argmax()), depth.shape)
    x, y = grid.geometry.world_of(np.array([row - 1 + low[0], col - 1 + low[1]]) + corner)
    return round(float(x), 3), round(float(y), 3)
