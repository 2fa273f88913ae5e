"""Ids, names and rooms when a model is made again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.geometry import IntArray
from core.mapping import GridGeometry, OccupancyGrid
from core.topology import Model, TopologicalMap
from core.topology.continuation import continued
from core.topology.labels import label_node, room_image
from core.topology.topology_of import topology_of

GEOMETRY = GridGeometry(0.1, (0.0, 0.0, 0.0), (30, 60))


def three_in_a_row(first: int = 20, second: int = 40) -> IntArray:
    """Three regions side by side, parted at these columns."""
    regions = np.ones(GEOMETRY.shape, np.int64)
    regions[:, first:] = 2
    regions[:, second:] = 3
    return regions


def topology(regions: IntArray, geometry: GridGeometry = GEOMETRY) -> TopologicalMap:
    return topology_of(OccupancyGrid(geometry, np.ones(geometry.shape, np.uint8)), regions)


def model(regions: IntArray) -> Model:
    grid = OccupancyGrid(GEOMETRY, np.ones(GEOMETRY.shape, np.uint8))
    made = label_node(topology(regions), "n2", "hall")
    return Model(grid, regions, room_image(regions, made), made, None, {})


def ids(found: TopologicalMap) -> dict[int, str]:
    return {node.region: node.id for node in found.nodes}


def test_regions_that_moved_a_little_keep_ids_names_rooms_and_doorways() -> None:
    earlier = model(three_in_a_row())
    regions = 4 - three_in_a_row(22, 43)
    found = continued(topology(regions), regions, GEOMETRY, earlier)
    assert ids(found) == {3: "n1", 2: "n2", 1: "n3"}
    assert found.node("n2").label == "hall"
    assert {room.id for room in found.rooms} == {room.id for room in earlier.topology.rooms}
    assert {edge.id for edge in found.edges} == {edge.id for edge in earlier.topology.edges}
    assert not any(node.came_from for node in found.nodes)


def test_a_region_that_was_cut_says_from_what_it_came_and_its_id_is_new() -> None:
    earlier = model(three_in_a_row())
    regions = three_in_a_row()
    regions[:, 33:40] = 4
    found = continued(topology(regions), regions, GEOMETRY, earlier)
    assert [ids(found)[region] for region in (1, 2, 3)] == ["n1", "n2", "n3"]
    new = next(node for node in found.nodes if node.region == 4)
    assert new.came_from == ("n2",)
    assert int(new.id[1:]) >= earlier.topology.next_number


def test_joined_regions_keep_the_id_of_the_larger_and_name_the_other() -> None:
    earlier = model(three_in_a_row(10, 40))
    regions = np.where(three_in_a_row(10, 40) == 1, 2, three_in_a_row(10, 40))
    found = continued(topology(regions), regions, GEOMETRY, earlier)
    assert ids(found) == {2: "n2", 3: "n3"}
    assert found.node("n2").came_from == ("n1",)


def test_an_id_that_is_gone_is_not_given_to_another_place() -> None:
    earlier = model(three_in_a_row())
    regions = np.where(three_in_a_row() == 1, 0, three_in_a_row())
    without = continued(topology(regions), regions, GEOMETRY, earlier)
    second = replace(earlier, topology=without, regions=regions)
    back = continued(topology(three_in_a_row()), three_in_a_row(), GEOMETRY, second)
    assert "n1" not in ids(back).values()
    assert {"n2", "n3"} < set(ids(back).values())


def test_a_grid_that_has_grown_changes_nothing() -> None:
    earlier = model(three_in_a_row())
    wide = GridGeometry(0.1, (-1.0, -0.5, 0.0), (40, 80))
    regions = np.pad(three_in_a_row(), ((5, 5), (10, 10)))
    found = continued(topology(regions, wide), regions, wide, earlier)
    assert ids(found) == {1: "n1", 2: "n2", 3: "n3"}
