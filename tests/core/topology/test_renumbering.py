"""Numbers of regions stay when a model is made again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.geometry import IntArray
from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.step_picture import StepPicture
from core.topology import Model
from core.topology.continuation import going_on
from core.topology.labels import room_image
from core.topology.timeline import picture_on_map
from core.topology.topology_of import topology_of

GEOMETRY = GridGeometry(0.1, (0.0, 0.0, 0.0), (30, 60))


def in_a_row(*numbers: int) -> IntArray:
    """Regions of these numbers side by side, each 20 columns wide."""
    return np.repeat(np.repeat([numbers], 20, axis=1), 30, axis=0)


def model(regions: IntArray) -> Model:
    grid = OccupancyGrid(GEOMETRY, np.ones(GEOMETRY.shape, np.uint8))
    topology = topology_of(grid, regions)
    return Model(grid, regions, room_image(regions, topology), topology, None, {})


def told_by_steps(made: Model) -> Model:
    """The model with a history of one step: region 9 was extracted, cut from region 2."""
    place = {"origin": [0.0, 0.0, 0.0], "resolution": 0.1}
    history = (
        {"event": "step", "step": 0, "said": "extracted region 9", "picture": place},
        {"event": "extract", "step": 0, "region": 9, "came_from": [2]},
        {"event": "extract", "step": 0, "region": None, "came_from": []},
    )
    none = np.zeros_like(made.regions)
    picture = StepPicture(made.grid.state, none, made.regions)
    return replace(made, history=history, timeline=(picture.png(),))


@pytest.fixture
def again() -> Model:
    """A model of three regions made again, whose regions came out in another order."""
    return going_on(told_by_steps(model(in_a_row(2, 9, 1))), model(in_a_row(1, 2, 3)))


def test_a_region_that_goes_on_keeps_its_number(again: Model) -> None:
    np.testing.assert_array_equal(again.regions, in_a_row(1, 2, 3))
    assert [(node.id, node.region) for node in again.topology.nodes] == [
        ("n1", 1),
        ("n2", 2),
        ("n3", 3),
    ]
    np.testing.assert_array_equal(again.rooms > 0, again.regions > 0)


def test_the_history_and_the_pictures_of_its_steps_go_along(again: Model) -> None:
    step, decision, waits = again.history
    assert step["said"] == "extracted region 2"
    assert (decision["region"], decision["came_from"]) == (2, [1])
    assert waits["region"] is None
    shown = picture_on_map(again.timeline[0], step, GEOMETRY)
    np.testing.assert_array_equal(shown.regions, again.regions)


def test_a_second_time_is_as_good_as_the_first(again: Model) -> None:
    third = going_on(again, model(in_a_row(3, 1, 7)))
    assert [node.region for node in third.topology.nodes] == [1, 3, 7]
    shown = picture_on_map(third.timeline[0], third.history[0], GEOMETRY)
    np.testing.assert_array_equal(shown.regions, third.regions)
    assert third.history[0]["said"] == "extracted region 1"


def test_a_new_region_gets_a_number_that_nobody_had() -> None:
    cut = in_a_row(3, 2, 1)
    cut[:, 33:40] = 4
    found = going_on(model(cut), model(in_a_row(4, 2, 1)))
    assert found.topology.node("n3").region == 4
    assert sorted(node.region for node in found.topology.nodes) == [1, 2, 4, 5]


def test_another_home_has_its_own_numbers() -> None:
    elsewhere = in_a_row(0, 2, 0)
    assert going_on(model(elsewhere), model(in_a_row(1, 0, 0))).topology.nodes[0].region == 2
