"""What the index knows of a model, read from its folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

TOPOLOGY_FILE = "topology.json"


def read_json(path: Path) -> dict[str, Any]:
    """A JSON file of ours."""
    content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return content


def facts_of(model_folder: Path) -> dict[str, Any]:
    """Number of nodes and rooms, free area, and every label."""
    topology = read_json(model_folder / TOPOLOGY_FILE)
    named = (*topology["nodes"], *topology["rooms"])
    return {
        "nodes": len(topology["nodes"]),
        "rooms": len(topology["rooms"]),
        "area_m2": sum(node["area_m2"] for node in topology["nodes"]),
        "labels": sorted({item["label"] for item in named if item["label"]}),
    }
