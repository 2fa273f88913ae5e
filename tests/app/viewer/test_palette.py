"""Colours that tell rooms apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.viewer.palette import PALETTE, hex_of, linear, mix, node_colours
from core.topology import Edge, Node, Room, TopologicalMap


def chain(count: int) -> TopologicalMap:
    nodes = tuple(Node(f"n{i}", i + 1, None, 9.0, (float(i), 0.0), 0.0) for i in range(count))
    edges = tuple(
        Edge(f"e{i}", f"n{i}", f"n{i + 1}", (i + 0.5, 0.0), 0.8) for i in range(count - 1)
    )
    rooms = tuple(Room(f"r{i}", i + 1, None, (f"n{i}",)) for i in range(count))
    return TopologicalMap(nodes, edges, rooms)


NO_REGIONS = np.zeros((20, 20), np.int64)


def test_up_to_twelve_nodes_all_have_their_own_hue():
    colours = node_colours(chain(12), NO_REGIONS)
    assert len(set(colours.values())) == 12


def test_neighbours_never_share_a_hue():
    topology = chain(40)
    colours = node_colours(topology, NO_REGIONS)
    assert len(set(colours.values())) > 12
    hue_of = {}
    for node, colour in colours.items():
        distance = [np.abs(np.subtract(colour, base)).sum() for base in PALETTE]
        hue_of[node] = int(np.argmin(distance))
    assert all(hue_of[edge.source] != hue_of[edge.target] for edge in topology.edges)


def test_rooms_with_only_a_wall_between_them_differ():
    topology = TopologicalMap(chain(24).nodes, (), ())
    regions = np.zeros((10, 24 * 4), np.int64)
    for index in range(24):
        regions[2:8, index * 4 : index * 4 + 2] = index + 1
    colours = node_colours(topology, regions)
    assert all(colours[f"n{i}"] != colours[f"n{i + 1}"] for i in range(23))


def test_an_edit_recolours_no_other_node():
    before = node_colours(chain(8), NO_REGIONS)
    merged = chain(8)
    merged = replace(merged, nodes=merged.nodes[:3] + merged.nodes[4:], edges=merged.edges[4:])
    after = node_colours(merged, NO_REGIONS, before)
    assert after == {node: colour for node, colour in before.items() if node != "n3"}
    again = node_colours(chain(8), NO_REGIONS, after)
    assert {node: again[node] for node in after} == after


def test_of_two_neighbours_that_had_one_hue_only_one_keeps_it():
    pair = chain(2)
    after = node_colours(pair, NO_REGIONS, {"n0": PALETTE[3], "n1": PALETTE[3]})
    assert PALETTE[3] in after.values()
    assert after["n0"] != after["n1"]


def test_naming_a_node_recolours_nothing():
    topology = chain(9)
    named = replace(
        topology,
        nodes=tuple(replace(node, label="kitchen") for node in topology.nodes),
        rooms=(Room("r", 1, "kitchen", tuple(node.id for node in topology.nodes)),),
    )
    assert node_colours(topology, NO_REGIONS) == node_colours(named, NO_REGIONS)


def test_no_nodes_no_colours():
    assert node_colours(TopologicalMap((), (), ()), NO_REGIONS) == {}


def test_srgb_becomes_linear():
    assert linear([(0, 0, 0), (255, 255, 255)]).tolist() == [[0, 0, 0], [255, 255, 255]]
    assert linear([(188, 188, 188)])[0, 0] == pytest.approx(128, abs=1)


def test_mixing_and_writing_colours():
    assert mix((0, 0, 0), (200, 100, 50), 0.5) == (100, 50, 25)
    assert hex_of((255, 0, 10)) == "#ff000a"
