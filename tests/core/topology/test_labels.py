from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError, ModelError
from core.mapping import GridGeometry, OccupancyGrid
from core.topology import TopologicalMap
from core.topology.labels import carried_labels, label_node, label_room, room_image
from core.topology.topology_of import topology_of

GEOMETRY = GridGeometry(0.1, (0.0, 0.0, 0.0), (10, 40))
REGIONS = np.repeat(np.repeat(np.array([[1, 2, 3, 4]]), 10, axis=0), 10, axis=1)
ROOMS = np.where(REGIONS <= 2, 1, REGIONS)


@pytest.fixture
def topology() -> TopologicalMap:
    """Four nodes in a row; the first two are suggested as one room."""
    grid = OccupancyGrid.of(GEOMETRY, REGIONS > 0, REGIONS == 0)
    return topology_of(grid, REGIONS, ROOMS)


def groups(topology: TopologicalMap) -> list[list[int]]:
    region = {node.id: node.region for node in topology.nodes}
    return sorted(sorted(region[n] for n in room.nodes) for room in topology.rooms)


def node_of(topology: TopologicalMap, region: int) -> str:
    return next(node.id for node in topology.nodes if node.region == region)


def test_touching_nodes_of_one_name_are_one_room_and_separate_ones_stay_two(
    topology: TopologicalMap,
) -> None:
    for region in (1, 2, 4):
        topology = label_node(topology, node_of(topology, region), "bedroom")
    assert groups(topology) == [[1, 2], [3], [4]]
    assert [room.label for room in topology.rooms].count("bedroom") == 2


def test_a_named_node_leaves_its_suggested_room_and_comes_back_unnamed(
    topology: TopologicalMap,
) -> None:
    assert groups(topology) == [[1, 2], [3], [4]]
    named = label_node(topology, node_of(topology, 1), "kitchen")
    assert groups(named) == [[1], [2], [3], [4]]
    back = label_node(named, node_of(topology, 1), None)
    assert groups(back) == [[1, 2], [3], [4]]


def test_naming_a_room_names_all_its_nodes_and_keeps_its_id(topology: TopologicalMap) -> None:
    room = max(topology.rooms, key=lambda room: len(room.nodes))
    named = label_room(topology, room.id, "  living room ")
    assert named.room(room.id).label == "living room"
    assert [n.label for n in named.nodes] == ["living room", "living room", None, None]


def test_the_room_image_shows_the_groups(topology: TopologicalMap) -> None:
    image = room_image(REGIONS, topology)
    assert len(np.unique(image)) == 3
    assert image[0, 0] == image[0, 15] != image[0, 25]


@pytest.mark.parametrize("label", ["x" * 81, "two\nlines", "bell\x07"])
def test_a_label_that_cannot_be_shown_is_refused(topology: TopologicalMap, label: str) -> None:
    with pytest.raises(InputError, match="label"):
        label_node(topology, topology.nodes[0].id, label)


def test_an_unknown_node_is_named_in_the_error(topology: TopologicalMap) -> None:
    with pytest.raises(ModelError, match="nope"):
        label_node(topology, "nope", "kitchen")


def test_labels_go_along_to_a_new_model_by_overlap(topology: TopologicalMap) -> None:
    old = label_node(topology, node_of(topology, 3), "hall")
    new_geometry = GridGeometry(0.1, (0.5, 0.0, 0.0), (10, 35))
    new_regions = np.ones((10, 35), int)
    new_regions[:, 14:26] = 2  # world x 1.9 .. 3.1; the old region 3 is 2.0 .. 3.0
    assert carried_labels(old, REGIONS, GEOMETRY, new_regions, new_geometry) == {2: "hall"}
