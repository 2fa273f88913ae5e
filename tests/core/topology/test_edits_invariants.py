"""Any sequence of edits, with undo and redo among them, keeps a model whole."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy import ndimage

from core.errors import InputError
from core.topology import Model
from core.topology.contacts import contacts
from core.topology.edits import merge_nodes, move_node, split_node
from core.topology.labels import label_node, room_image
from core.topology.model_folder import read_model, store_edit, write_model

POINT = st.tuples(st.floats(-0.5, 7.0), st.floats(-0.5, 2.7))
INDEX = st.integers(0, 30)
EDIT = st.one_of(
    st.tuples(st.just("merge"), st.lists(INDEX, min_size=2, max_size=3)),
    st.tuples(st.just("merge neighbours"), INDEX),
    st.tuples(st.just("split"), INDEX, st.lists(POINT, min_size=2, max_size=4)),
    st.tuples(st.just("split across"), INDEX, st.floats(0, np.pi), st.floats(-0.5, 0.5)),
    st.tuples(st.just("move"), INDEX, st.none() | INDEX),
    st.tuples(st.just("label"), INDEX, st.sampled_from([None, "kitchen", "hall"])),
)


def node_at(model: Model, index: int) -> str:
    return model.topology.nodes[index % len(model.topology.nodes)].id


def across(model: Model, index: int, angle: float, offset: float) -> list[tuple[float, float]]:
    """A line through the neighbourhood of a node, from far away to far away."""
    node = model.topology.nodes[index % len(model.topology.nodes)]
    way = np.array([np.cos(angle), np.sin(angle)])
    middle = np.array(node.position) + offset * np.array([-way[1], way[0]])
    return [tuple(middle - 9 * way), tuple(middle + 9 * way)]


def edited(model: Model, edit: tuple[Any, ...]) -> Model:
    """The model after an edit; as it was when the edit is refused for a reason."""
    topology = model.topology
    try:
        match edit:
            case ("merge", indices):
                return merge_nodes(model, [node_at(model, i) for i in indices])
            case ("merge neighbours", index) if topology.edges:
                edge = topology.edges[index % len(topology.edges)]
                return merge_nodes(model, [edge.source, edge.target])
            case ("split", index, line):
                return split_node(model, node_at(model, index), line)
            case ("split across", index, angle, offset):
                return split_node(model, node_at(model, index), across(model, index, angle, offset))
            case ("move", index, room):
                rooms = topology.rooms
                target = None if room is None else rooms[room % len(rooms)].id
                return move_node(model, node_at(model, index), target)
            case ("label", index, label):
                named = label_node(topology, node_at(model, index), label)
                rooms = room_image(model.regions, named)
                return Model(
                    model.grid, model.regions, rooms, named, None, model.provenance, model.history
                )
    except InputError as error:
        check_reason(str(error))
    return model


def check_reason(message: str) -> None:
    """A refusal is one line that says what is wrong."""
    assert len(message) > 15
    assert "\n" not in message


def ids_of(model: Model) -> list[str]:
    topology = model.topology
    return [item.id for item in (*topology.nodes, *topology.edges, *topology.rooms)]


def check_whole(model: Model, floor: np.ndarray) -> None:
    """Floor, regions, edges and rooms fit each other."""
    topology = model.topology
    np.testing.assert_array_equal(model.regions > 0, floor)
    values = [node.region for node in topology.nodes]
    assert sorted(values) == np.unique(model.regions[floor]).tolist()
    for node in topology.nodes:
        mask = model.regions == node.region
        assert ndimage.label(mask)[1] == 1
        assert abs(node.area_m2 - mask.sum() * model.grid.geometry.cell_area) < 1e-3
        row, col = model.grid.geometry.cell_of(node.position)
        assert mask[row, col]
    ids = ids_of(model)
    assert len(set(ids)) == len(ids)
    region = {node.id: node.region for node in topology.nodes}
    expected = sorted(
        (c.low, c.high, round(c.middle[0], 3), round(c.middle[1], 3), round(c.width_m, 3))
        for c in contacts(model.regions, model.grid.geometry)
    )
    found = sorted(
        (region[e.source], region[e.target], *e.doorway, e.width_m) for e in topology.edges
    )
    assert found == expected
    members = [node for room in topology.rooms for node in room.nodes]
    assert sorted(members) == sorted(region)
    np.testing.assert_array_equal(model.rooms, room_image(model.regions, topology))
    for room in topology.rooms:
        assert ndimage.label(model.rooms == room.room)[1] == 1


def check_change(before: Model, after: Model, used: set[str]) -> None:
    """New ids are new, and what was not touched is as it was."""
    fresh = set(ids_of(after)) - set(ids_of(before))
    assert not fresh & used
    numbers = [int(item[1:]) for item in (*used, *ids_of(after))]
    assert after.topology.next_number > max(numbers)
    same = {
        node.id
        for node in after.topology.nodes
        if any(
            old.id == node.id
            and np.array_equal(before.regions == old.region, after.regions == node.region)
            for old in before.topology.nodes
        )
    }
    assert {e for e in before.topology.edges if {e.source, e.target} <= same} == {
        e for e in after.topology.edges if {e.source, e.target} <= same
    }


@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(edits=st.lists(EDIT, min_size=1, max_size=8))
def test_any_sequence_of_edits_keeps_the_model_whole(home: Model, edits: list[Any]) -> None:
    model, floor, used = home, home.regions > 0, set(ids_of(home))
    for edit in edits:
        after = edited(model, edit)
        check_whole(after, floor)
        check_change(model, after, used)
        used |= set(ids_of(after))
        model = after


@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(edits=st.lists(EDIT, min_size=1, max_size=4))
def test_an_edited_model_is_stored_and_read_back_the_same(
    home: Model, edits: list[Any], tmp_path_factory: Any
) -> None:
    folder = tmp_path_factory.mktemp("model")
    write_model(home, folder)
    model = home
    for edit in edits:
        model = edited(model, edit)
    store_edit(model, folder)
    back = read_model(folder)
    assert back.topology == model.topology
    np.testing.assert_array_equal(back.regions, model.regions)
    np.testing.assert_array_equal(back.rooms, model.rooms)


def test_splits_of_the_known_home_succeed_often_enough_to_mean_something(home: Model) -> None:
    angles, indices = np.linspace(0, np.pi, 12, endpoint=False), range(4)
    parted = [
        len(edited(home, ("split across", i, angle, 0.0)).topology.nodes) == 5
        for i in indices
        for angle in angles
    ]
    assert np.mean(parted) > 0.9
