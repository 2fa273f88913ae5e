from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError, ModelError
from core.topology import Edge, Model
from core.topology.edits import merge_nodes, move_node, split_node
from core.topology.labels import label_node
from core.topology.model_folder import read_model, store_edit, write_model


def node_id(model: Model, region: int) -> str:
    return next(node.id for node in model.topology.nodes if node.region == region)


def named(model: Model, **labels: str) -> Model:
    """The model with regions named: r3="kitchen"."""
    topology = model.topology
    for key, label in labels.items():
        topology = label_node(topology, node_id(model, int(key[1:])), label)
    return Model(model.grid, model.regions, model.rooms, topology, None, {})


def groups(model: Model) -> list[list[int]]:
    region = {node.id: node.region for node in model.topology.nodes}
    return sorted(sorted(region[n] for n in room.nodes) for room in model.topology.rooms)


def room_with(model: Model, region: int) -> str:
    return next(r.id for r in model.topology.rooms if node_id(model, region) in r.nodes)


def edge_between(model: Model, a: int, b: int) -> Edge:
    ends = {node_id(model, a), node_id(model, b)}
    (edge,) = [e for e in model.topology.edges if {e.source, e.target} == ends]
    return edge


def test_merged_nodes_are_one_node_with_the_id_of_the_larger(home: Model) -> None:
    a, b = node_id(home, 2), node_id(home, 3)
    merged = merge_nodes(home, [a, b])
    node = merged.topology.node(b)
    assert node.area_m2 == pytest.approx(4.0 + 0.06 + 2.0 + 0.06)
    assert node.came_from == (b, a)
    assert {n.id for n in merged.topology.nodes} == {n.id for n in home.topology.nodes} - {a}
    assert set(np.unique(merged.regions)) == {0, 1, 3, 4}


def test_a_merge_keeps_the_edges_that_it_does_not_end(home: Model) -> None:
    merged = merge_nodes(home, [node_id(home, 2), node_id(home, 3)])
    assert edge_between(merged, 3, 4) == edge_between(home, 3, 4)
    moved = edge_between(merged, 1, 3)
    assert moved.id == edge_between(home, 1, 2).id
    assert moved.doorway == edge_between(home, 1, 2).doorway
    assert len(merged.topology.edges) == len(home.topology.edges) - 1


def test_a_merge_keeps_a_label_that_only_the_smaller_part_has(home: Model) -> None:
    model = named(home, r2="pantry")
    merged = merge_nodes(model, [node_id(model, 2), node_id(model, 3)])
    assert merged.topology.node(node_id(merged, 3)).label == "pantry"


def test_of_two_labels_a_merge_keeps_that_of_the_larger_part(home: Model) -> None:
    model = named(home, r2="pantry", r3="kitchen")
    merged = merge_nodes(model, [node_id(model, 2), node_id(model, 3)])
    assert merged.topology.node(node_id(merged, 3)).label == "kitchen"


def test_three_nodes_in_a_row_merge_in_any_order(home: Model) -> None:
    ids = [node_id(home, region) for region in (1, 3, 2)]
    assert groups(merge_nodes(home, ids)) == [[3], [4]]


def test_nodes_that_do_not_touch_are_named(home: Model) -> None:
    model = named(home, r4="bath")
    with pytest.raises(ModelError, match="Region 1 does not touch bath"):
        merge_nodes(model, [node_id(model, 1), node_id(model, 4)])


def test_one_node_cannot_be_merged_with_itself(home: Model) -> None:
    with pytest.raises(InputError, match="two different"):
        merge_nodes(home, ["n1", "n1"])


def test_a_split_along_the_middle_gives_two_halves(home: Model) -> None:
    model = named(home, r4="bath")
    old = node_id(model, 4)
    split = split_node(model, old, [(5.3, 0.0), (5.3, 2.2)])
    kept, new = split.topology.node(old), split.topology.nodes[-1]
    # 10 columns of 20 cells left of the line, 9 right of it and the one under it.
    assert (kept.area_m2, new.area_m2) == pytest.approx((2.0, 2.0))
    assert kept.label == new.label == "bath"
    assert kept.came_from == new.came_from == (old,)
    assert new.id not in {n.id for n in model.topology.nodes}
    assert edge_between(split, 4, new.region).width_m == pytest.approx(2.0)
    assert groups(split) == [[1, 2], [3], [4, new.region]]


def test_a_split_keeps_the_ids_of_edges_where_they_are(home: Model) -> None:
    split = split_node(home, node_id(home, 3), [(3.2, 0.0), (3.2, 2.2)])
    before = {(e.id, e.doorway) for e in home.topology.edges}
    assert before <= {(e.id, e.doorway) for e in split.topology.edges}


def test_a_line_that_ends_near_the_walls_is_drawn_on_to_them(home: Model) -> None:
    split = split_node(home, node_id(home, 4), [(5.3, 0.5), (5.3, 1.7)])
    assert len(split.topology.nodes) == 5


def test_a_line_that_just_misses_a_corner_is_brought_to_it(home: Model) -> None:
    """A wall reaches 1 m into region 4; the line from below ends 0.2 m beside the wall's end."""
    regions = home.regions.copy()
    regions[11:21, 53] = 0
    model = Model(home.grid, regions, regions, home.topology, None, {})
    split = split_node(model, node_id(home, 4), [(5.6, 0.0), (5.6, 0.95)])
    assert split.topology.nodes[-1].area_m2 == pytest.approx(1.65, abs=0.15)


def test_a_bent_line_cuts_off_a_corner(home: Model) -> None:
    split = split_node(home, node_id(home, 4), [(5.3, 0.0), (5.3, 1.1), (6.4, 1.1)])
    assert split.topology.nodes[-1].area_m2 == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ([(0.5, 0.0), (0.5, 2.0)], "misses"),
        ([(100.0, 100.0), (200.0, 100.0)], "misses"),
        ([(6.25, 0.0), (6.15, 2.2)], "leaves a piece of 0.10 m² of Region 4, less than 0.15 m²"),
        ([(4.35, 0.0), (4.35, 2.2)], "only touches its border"),
        ([(5.3, 0.0), (5.3, 0.6)], "ends inside Region 4, more than 1 m from its border"),
        (
            [(4.8, -0.5), (4.8, 2.5), (5.8, 2.5), (5.8, -0.5)],
            "into 3 pieces, not two",
        ),
    ],
)
def test_a_line_that_does_not_part_a_node_in_two_says_why(
    home: Model, line: list[tuple[float, float]], reason: str
) -> None:
    with pytest.raises(ModelError, match=reason):
        split_node(home, node_id(home, 4), line)


@pytest.mark.parametrize(
    "line",
    [
        [],
        [(1.0, 1.0)],
        [(1.0, 1.0)] * 3,
        [(1.0, 0.0), (1.0, 1e-320)],
        [(np.nan, 0), (1, 1)],
        [(1e9, 0), (1, 1)],
        [(1, 2, 3)] * 2,
    ],
)
def test_a_line_that_is_none_is_refused(home: Model, line: list[tuple[float, ...]]) -> None:
    with pytest.raises(InputError, match="line"):
        split_node(home, node_id(home, 4), line)


def test_one_cannot_split_along_a_line_with_a_way_round_it(home: Model) -> None:
    """A pillar in the middle of region 4; the line goes from the wall to the pillar."""
    regions = home.regions.copy()
    regions[8:14, 50:56] = 0
    model = Model(home.grid, regions, regions, home.topology, None, {})
    with pytest.raises(ModelError, match="walk round"):
        split_node(model, node_id(home, 4), [(5.3, 0.0), (5.3, 1.0)])


def test_a_node_moves_to_an_unnamed_room(home: Model) -> None:
    moved = move_node(home, node_id(home, 2), room_with(home, 3))
    assert groups(moved) == [[1], [2, 3], [4]]
    assert room_with(moved, 3) == room_with(home, 3)
    assert moved.rooms[10, 15] == moved.rooms[10, 30] != moved.rooms[10, 5]


def test_a_node_takes_the_name_of_the_room_it_moves_to(home: Model) -> None:
    model = named(home, r3="kitchen", r2="pantry")
    moved = move_node(model, node_id(model, 2), room_with(model, 3))
    assert moved.topology.node(node_id(moved, 2)).label == "kitchen"
    assert groups(moved) == [[1], [2, 3], [4]]


def test_a_named_node_that_was_a_room_gives_its_name_to_an_unnamed_one(home: Model) -> None:
    model = named(home, r3="kitchen")
    moved = move_node(model, node_id(model, 3), room_with(model, 1))
    assert groups(moved) == [[1, 2, 3], [4]]
    assert {n.label for n in moved.topology.nodes} == {"kitchen", None}


def test_a_node_that_leaves_a_named_room_leaves_its_name(home: Model) -> None:
    model = named(home, r1="living room", r2="living room")
    moved = move_node(model, node_id(model, 2), room_with(model, 3))
    assert moved.topology.node(node_id(moved, 2)).label is None
    assert groups(moved) == [[1], [2, 3], [4]]


def test_a_node_becomes_a_room_of_its_own(home: Model) -> None:
    alone = move_node(home, node_id(home, 2), None)
    assert groups(alone) == [[1], [2], [3], [4]]
    with pytest.raises(ModelError, match="Region 2 is a room of its own already"):
        move_node(alone, node_id(alone, 2), None)


def test_a_node_cannot_move_to_a_room_that_it_does_not_touch_or_is_in(home: Model) -> None:
    with pytest.raises(ModelError, match="Region 4 does not touch room 1"):
        move_node(home, node_id(home, 4), room_with(home, 1))
    with pytest.raises(ModelError, match="already"):
        move_node(home, node_id(home, 1), room_with(home, 1))
    with pytest.raises(ModelError, match="no room 'nope'"):
        move_node(home, node_id(home, 1), "nope")


def test_edits_are_told_in_the_history_and_read_back(home: Model, tmp_path: object) -> None:
    from pathlib import Path

    folder = Path(str(tmp_path)) / "home"
    write_model(home, folder)
    split = split_node(read_model(folder), node_id(home, 4), [(5.3, 0.0), (5.3, 2.2)])
    store_edit(split, folder)
    back = read_model(folder)
    assert back.topology == split.topology
    np.testing.assert_array_equal(back.regions, split.regions)
    assert back.history[-1] == {
        "event": "edit",
        "op": "split",
        "node": node_id(home, 4),
        "new": split.topology.nodes[-1].id,
        "line": [[5.3, 0.0], [5.3, 2.2]],
    }
