from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.mapping import GridGeometry, OccupancyGrid
from core.topology import Model
from core.topology.comparison import compare, different_parameters
from core.topology.topological_map import Node, TopologicalMap


def model(columns: tuple[int, ...], origin_x: float = 0.0, **provenance: object) -> Model:
    """Rooms of 1 m depth side by side, so many cells of 10 cm wide each."""
    labels = np.repeat(np.arange(1, len(columns) + 1), columns)[None].repeat(10, axis=0)
    geometry = GridGeometry(0.1, (origin_x, 0.0, 0.0), labels.shape)
    grid = OccupancyGrid.of(geometry, labels > 0, np.zeros(labels.shape, bool))
    ends = np.cumsum((0, *columns)) * 0.1 + origin_x
    nodes = tuple(
        Node(f"n{i + 1}", i + 1, None, width * 0.1, ((ends[i] + ends[i + 1]) / 2, 0.5), 0.0)
        for i, width in enumerate(columns)
    )
    return Model(grid, labels, labels, TopologicalMap(nodes, (), ()), None, provenance)


def test_a_model_is_the_same_as_itself() -> None:
    found = compare(model((10, 20)), model((10, 20)))
    assert [(p.first, p.second, p.overlap, p.moved) for p in found.nodes] == [
        ("n1", "n1", 1.0, 0.0),
        ("n2", "n2", 1.0, 0.0),
    ]
    assert found.free_overlap == 1.0
    assert not found.only_first
    assert not found.only_second
    assert not found.parameters


def test_a_room_that_was_cut_in_two_has_one_partner_and_a_rest() -> None:
    found = compare(model((30,)), model((20, 10)))
    (pair,) = found.nodes
    assert pair.second == "n1"
    assert pair.overlap == pytest.approx(20 / 30)
    assert pair.area_change == pytest.approx(-1.0)
    assert pair.moved == pytest.approx(0.5)
    assert found.only_second == ("n2",)


def test_grids_of_other_corners_lie_where_they_are_in_the_world() -> None:
    found = compare(model((10, 10)), model((10,), origin_x=1.0))
    assert [(p.first, p.second) for p in found.nodes] == [("n2", "n1")]
    assert found.free_overlap == pytest.approx(0.5)


def test_models_that_do_not_overlap_have_nothing_in_common() -> None:
    found = compare(model((10,)), model((10,), origin_x=50.0))
    assert found.nodes == ()
    assert (found.only_first, found.only_second, found.free_overlap) == (("n1",), ("n1",), 0.0)


def test_only_parameters_that_differ_are_told() -> None:
    one = {"mapping": {"method": "cemal", "resolution": 0.05}, "versions": {"numpy": "1"}}
    two = {"mapping": {"method": "bayes", "resolution": 0.05}, "seed": 3, "versions": {}}
    assert different_parameters(one, two) == {
        "mapping.method": ("cemal", "bayes"),
        "seed": (None, 3),
    }


def test_nodes_keep_their_order_by_overlap() -> None:
    shifted = model((8, 22))
    found = compare(model((10, 20)), replace(shifted))
    assert [round(p.overlap, 2) for p in found.nodes] == [0.91, 0.8]
