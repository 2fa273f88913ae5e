from __future__ import annotations

import numpy as np
import pytest

from core.mapping import GridGeometry, OccupancyGrid
from core.topology.topology_of import topology_of


def home(regions: np.ndarray) -> OccupancyGrid:
    geometry = GridGeometry(0.1, (1.0, 2.0, 0.0), regions.shape)
    return OccupancyGrid.of(geometry, regions > 0, regions == 0)


def two_doors() -> np.ndarray:
    """Two regions that touch in two places."""
    regions = np.ones((20, 21), int)
    regions[:, 11:] = 2
    regions[:, 10] = 0
    regions[2:6, 10] = 1
    regions[14:17, 10] = 1
    return regions


def test_two_regions_with_two_doorways_have_two_edges() -> None:
    regions = two_doors()
    topology = topology_of(home(regions), regions)
    assert [node.region for node in topology.nodes] == [1, 2]
    widths = sorted(edge.width_m for edge in topology.edges)
    assert widths == pytest.approx([0.3, 0.4])
    for edge in topology.edges:
        assert edge.doorway[0] == pytest.approx(2.1)


def test_a_node_stands_in_the_middle_of_its_region_and_knows_its_area() -> None:
    regions = np.zeros((13, 13), int)
    regions[1:12, 1:12] = 4
    node = topology_of(home(regions), regions).nodes[0]
    assert node.area_m2 == pytest.approx(1.21)
    assert node.position == pytest.approx((1.65, 2.65))
    assert node.convexity == 0


def test_ids_are_never_used_twice() -> None:
    regions = two_doors()
    topology = topology_of(home(regions), regions)
    ids = [x.id for x in (*topology.nodes, *topology.edges, *topology.rooms)]
    assert len(set(ids)) == len(ids)
    again = topology_of(home(regions), regions, next_number=topology.next_number)
    assert not {x.id for x in again.nodes} & {x.id for x in topology.nodes}


def test_suggested_rooms_group_nodes() -> None:
    regions = two_doors()
    topology = topology_of(home(regions), regions, rooms=np.where(regions > 0, 1, 0))
    assert len(topology.rooms) == 1
    assert set(topology.rooms[0].nodes) == {node.id for node in topology.nodes}


def test_a_hole_in_a_wall_is_no_doorway_unless_nothing_else_joins() -> None:
    regions = two_doors()
    regions[10, 10] = 1
    assert len(topology_of(home(regions), regions).edges) == 2
    regions[:, 10] = 0
    regions[10, 10] = 1
    assert len(topology_of(home(regions), regions).edges) == 1


def test_a_single_region_has_no_doorway() -> None:
    regions = np.ones((5, 8), int)
    topology = topology_of(home(regions), regions)
    assert [node.area_m2 for node in topology.nodes] == [pytest.approx(0.4)]
    assert topology.edges == ()
