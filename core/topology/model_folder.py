"""The model folder: a model as files that other programs read (map_server, PNG, JSON, CSV)."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from pydantic import BaseModel, ConfigDict, ValidationError

from core.errors import ModelError
from core.geometry import IntArray
from core.log_readers.safe_yaml import describe
from core.mapping.drift_view import DRIFT_FILE, ODOMETRY_MAP_FILE, DriftView
from core.mapping.map_server import read_map, write_map
from core.sensing import Trajectory
from core.topology.labels import room_image
from core.topology.model import Model
from core.topology.timeline_file import TIMELINE_FILE, read_timeline, write_timeline
from core.topology.topological_map import Edge, Node, Room, TopologicalMap

FORMAT, VERSION = "echorooms-topology", 1
MAX_REGIONS = 65535
"""The largest value of a 16-bit label image."""


class _NodeFile(BaseModel):
    model_config = ConfigDict(extra="ignore", allow_inf_nan=False)
    id: str
    region: int
    label: str | None
    area_m2: float
    position: tuple[float, float]
    convexity: float
    suggested_room: int = 0
    came_from: tuple[str, ...] = ()


class _EdgeFile(BaseModel):
    model_config = ConfigDict(extra="ignore", allow_inf_nan=False)
    id: str
    source: str
    target: str
    doorway: tuple[float, float]
    width_m: float


class _RoomFile(BaseModel):
    model_config = ConfigDict(extra="ignore")
    id: str
    room: int
    label: str | None
    nodes: tuple[str, ...]


class _TopologyFile(BaseModel):
    model_config = ConfigDict(extra="ignore")
    format: str
    version: int
    nodes: list[_NodeFile]
    edges: list[_EdgeFile]
    rooms: list[_RoomFile] = []
    next_number: int = 1


def write_model(model: Model, folder: Path) -> None:
    """Writes a model into a folder, which is made when it does not exist.

    Raises:
        ModelError: more regions than a 16-bit label image holds.
    """
    folder.mkdir(parents=True, exist_ok=True)
    write_map(model.grid, folder)
    _write_labels(folder / "regions.png", model.regions)
    _write_labels(folder / "rooms.png", model.rooms)
    if model.trajectory is not None:
        model.trajectory.write_csv(folder / "trajectory.csv")
    _write_history(folder / "history.jsonl", model.history)
    if model.timeline:
        write_timeline(model.timeline, folder / TIMELINE_FILE)
    if model.drift is not None:
        (folder / DRIFT_FILE).write_text(json.dumps(model.drift.report), encoding="utf-8")
        if model.drift.odometry_map is not None:
            (folder / ODOMETRY_MAP_FILE).write_bytes(model.drift.odometry_map)
    (folder / "provenance.json").write_text(
        json.dumps(model.provenance, indent=1, allow_nan=False) + "\n", encoding="utf-8"
    )
    write_topology(model.topology, folder)


def read_model(folder: Path) -> Model:
    """Reads a model folder.

    Raises:
        ModelError: a file is missing or does not fit the others.
        MapError: the map cannot be read.
    """
    if not (folder / "topology.json").is_file():
        raise ModelError(f"{folder.name} is no model folder: it has no topology.json")
    grid = read_map(folder / "map.yaml", folder / "map.pgm")
    topology = read_topology(folder)
    regions = _read_labels(folder / "regions.png", grid.geometry.shape)
    unknown = {node.region for node in topology.nodes} - set(np.unique(regions).tolist())
    if unknown:
        raise ModelError(f"topology.json names region {min(unknown)}, which regions.png lacks")
    trajectory = folder / "trajectory.csv"
    return Model(
        grid,
        regions,
        room_image(regions, topology),
        topology,
        Trajectory.read_csv(trajectory) if trajectory.is_file() else None,
        _read_json(folder / "provenance.json") if (folder / "provenance.json").is_file() else {},
        read_history(folder),
        read_timeline(folder / TIMELINE_FILE),
        _read_drift(folder),
    )


def _read_drift(folder: Path) -> DriftView | None:
    """The drive before and after its correction; None where that was not kept."""
    picture = folder / ODOMETRY_MAP_FILE
    if not (folder / DRIFT_FILE).is_file():
        return None
    report = _read_json(folder / DRIFT_FILE)
    return DriftView(report, picture.read_bytes() if picture.is_file() else None)


def write_topology(topology: TopologicalMap, folder: Path) -> None:
    """Replaces `topology.json` in one step: a reader sees the old one or the new one."""
    content = {"format": FORMAT, "version": VERSION, **asdict(topology)}
    text = json.dumps(content, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
    _replace(folder / "topology.json", text.encode())


def read_topology(folder: Path) -> TopologicalMap:
    """Reads `topology.json`.

    Raises:
        ModelError: it is missing or not what it should be.
    """
    content = _read_json(folder / "topology.json")
    try:
        file = _TopologyFile.model_validate(content)
    except ValidationError as error:
        raise ModelError(f"topology.json: {describe(error)}") from error
    if file.format != FORMAT or file.version != VERSION:
        raise ModelError(f"topology.json: not {FORMAT!r} version {VERSION}")
    topology = TopologicalMap(
        tuple(Node(**node.model_dump()) for node in file.nodes),
        tuple(Edge(**edge.model_dump()) for edge in file.edges),
        tuple(Room(**room.model_dump()) for room in file.rooms),
        file.next_number,
    )
    known = {node.id for node in topology.nodes}
    ends = {end for edge in topology.edges for end in (edge.source, edge.target)}
    missing = sorted((ends | {n for room in topology.rooms for n in room.nodes}) - known)
    if missing:
        raise ModelError(f"topology.json: there is no node {missing[0]!r}")
    return topology


def store_labels(topology: TopologicalMap, folder: Path) -> None:
    """Stores a map whose labels or rooms have changed: `rooms.png` and `topology.json`.

    The regions stay as they are. `topology.json` is replaced last, as it is the truth.
    """
    shape = read_map(folder / "map.yaml", folder / "map.pgm").geometry.shape
    regions = _read_labels(folder / "regions.png", shape)
    _write_labels(folder / "rooms.png", room_image(regions, topology))
    write_topology(topology, folder)


def store_edit(model: Model, folder: Path) -> None:
    """Stores a model whose regions have been edited; `topology.json` is replaced last.

    Raises:
        ModelError: more regions than a 16-bit label image holds.
    """
    _write_labels(folder / "regions.png", model.regions)
    _write_labels(folder / "rooms.png", model.rooms)
    _write_history(folder / "history.jsonl", model.history)
    write_topology(model.topology, folder)


def _write_labels(path: Path, labels: IntArray) -> None:
    """A 16-bit PNG, row 0 at the top, replaced in one step."""
    if labels.max(initial=0) > MAX_REGIONS:
        raise ModelError(f"{path.name} can hold {MAX_REGIONS} regions, not {labels.max()}")
    fresh = path.with_suffix(".new")
    Image.fromarray(np.ascontiguousarray(labels[::-1]).astype(np.uint16)).save(fresh, "PNG")
    fresh.replace(path)


def _read_labels(path: Path, shape: tuple[int, int]) -> IntArray:
    try:
        with Image.open(path) as image:
            labels = np.asarray(image).astype(np.int64)
    except OSError as error:
        raise ModelError(f"{path.name}: {error.strerror or 'is no picture'}") from error
    if labels.shape != shape:
        raise ModelError(f"{path.name} has {labels.shape} cells, the map has {shape}")
    return np.ascontiguousarray(labels[::-1])


def _read_json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ModelError(f"{path.name}: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise ModelError(f"{path.name} is no JSON: {error}") from error


def read_history(folder: Path) -> tuple[dict[str, Any], ...]:
    """The steps, decisions and edits in `history.jsonl`; none when there is no such file.

    Raises:
        ModelError: it is not what it should be.
    """
    path = folder / "history.jsonl"
    if not path.is_file():
        return ()
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
        entries = tuple(json.loads(line) for line in lines if line.strip())
    except (ValueError, RecursionError) as error:
        raise ModelError(f"{path.name} is no JSON: {error}") from error
    if not all(isinstance(entry, dict) for entry in entries):
        raise ModelError(f"{path.name}: every line must be an object")
    return entries


def _write_history(path: Path, history: Sequence[Mapping[str, Any]]) -> None:
    lines = (json.dumps(entry, allow_nan=False) + "\n" for entry in history)
    _replace(path, "".join(lines).encode())


def _replace(path: Path, data: bytes) -> None:
    fresh = path.with_suffix(".new")
    fresh.write_bytes(data)
    fresh.replace(path)
