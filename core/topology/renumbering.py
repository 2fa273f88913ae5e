"""Numbers of regions when a model is made again: people say "Region 4", so it stays Region 4.

The region of a node that goes on keeps the number that it had; all others get numbers that the
earlier model does not use. What the history tells of regions goes along, in figures and in words;
the pictures of its steps stay as they are, and each step says what their numbers mean.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from core.topology.labels import with_rooms
from core.topology.model import Model
from core.topology.topological_map import TopologicalMap

NAMED = re.compile(r"\bregion (\d+)")
"""A region in the words of a step."""


def renumbered(model: Model, earlier: TopologicalMap) -> Model:
    """A model whose nodes already have the ids of an earlier one, with its numbers of regions, too.

    Where no node goes on, nothing changes. The image of the rooms stays to be made.
    """
    numbers = _numbers(model, earlier)
    if all(value == number for value, number in numbers.items()):
        return model
    table = np.arange(int(model.regions.max(initial=0)) + 1)
    for value, number in numbers.items():
        if value < len(table):
            table[value] = number
    regions = table[model.regions]
    moved = (replace(node, region=numbers[node.region]) for node in model.topology.nodes)
    nodes = tuple(sorted(moved, key=lambda node: node.region))
    topology = with_rooms(replace(model.topology, nodes=nodes))
    return replace(
        model,
        regions=regions,
        topology=topology,
        history=tuple(_retold(entry, numbers) for entry in model.history),
    )


def _numbers(model: Model, earlier: TopologicalMap) -> dict[int, int]:
    """The new number of every region that the model or its history tells of; each number once."""
    before = {node.id: node.region for node in earlier.nodes}
    kept = {n.region: before[n.id] for n in model.topology.nodes if n.id in before}
    if not kept:
        return {}
    told = {node.region for node in model.topology.nodes}.union(*map(_told, model.history))
    used = set(before.values())
    fresh = max(told | used) + 1
    numbers = dict(kept)
    for value in sorted(told - set(kept)):
        numbers[value] = fresh if value in used else value
        fresh += value in used
    return numbers


def _told(entry: Mapping[str, Any]) -> set[int]:
    """The numbers of regions in an entry of the history."""
    came_from = entry.get("came_from", ()) if entry.get("event") == "extract" else ()
    region = entry.get("region")
    return {*came_from, *([region] if isinstance(region, int) else [])}


def _retold(entry: Mapping[str, Any], numbers: Mapping[int, int]) -> Mapping[str, Any]:
    """An entry of the history with other numbers of regions."""
    if entry.get("event") == "extract":
        region, came_from = entry.get("region"), entry.get("came_from", ())
        told = {"region": numbers.get(region, region) if isinstance(region, int) else region}
        return {**entry, **told, "came_from": [numbers.get(value, value) for value in came_from]}
    if entry.get("event") == "step" and "picture" in entry:
        said = NAMED.sub(
            lambda found: f"region {numbers.get(int(found[1]), int(found[1]))}",
            str(entry.get("said", "")),
        )
        drawn = {int(key): value for key, value in entry["picture"].get("numbers", {}).items()}
        meant = {value: numbers.get(now, now) for value, now in drawn.items()}
        meant = {value: now for value, now in numbers.items() if value not in drawn} | meant
        picture = {**entry["picture"], "numbers": {str(key): meant[key] for key in sorted(meant)}}
        return {**entry, "said": said, "picture": picture}
    return entry
