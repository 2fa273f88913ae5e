from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from core.errors import EchoRoomsError, ModelError
from core.pipeline.modeller import ModellingOptions, model_log
from core.sensing import RobotLog
from core.topology import Model
from core.topology.labels import label_node
from core.topology.model_folder import (
    read_model,
    read_topology,
    store_labels,
    write_model,
)


@pytest.fixture(scope="module")
def model(square_room: RobotLog) -> Model:
    return model_log(square_room, ModellingOptions(regions=3))


@pytest.fixture
def folder(model: Model, tmp_path: Path) -> Path:
    write_model(model, tmp_path / "home")
    return tmp_path / "home"


def test_a_written_model_reads_back_the_same(model: Model, folder: Path) -> None:
    back = read_model(folder)
    np.testing.assert_array_equal(back.grid.state, model.grid.state)
    np.testing.assert_array_equal(back.regions, model.regions)
    np.testing.assert_array_equal(back.rooms, model.rooms)
    assert back.topology == model.topology
    assert back.trajectory is not None
    assert model.trajectory is not None
    np.testing.assert_allclose(back.trajectory.poses, model.trajectory.poses, atol=1e-5)
    assert back.provenance["options"]["regions"] == 3


def test_the_files_are_those_of_the_contract(folder: Path) -> None:
    with Image.open(folder / "regions.png") as regions, Image.open(folder / "map.pgm") as grid:
        assert regions.mode == "I;16"
        assert regions.size == grid.size
    topology = json.loads((folder / "topology.json").read_text())
    assert topology["format"] == "echorooms-topology"
    assert topology["version"] == 1
    assert {"id", "region", "label", "area_m2", "position", "convexity"} <= set(
        topology["nodes"][0]
    )
    assert {"id", "source", "target", "doorway", "width_m"} <= set(topology["edges"][0])
    assert {"id", "room", "label", "nodes"} <= set(topology["rooms"][0])
    header = (folder / "trajectory.csv").read_text().splitlines()[0]
    assert header == "t,x,y,heading,sigma_xy,sigma_heading"


def test_a_label_is_stored_and_nothing_else_changes(folder: Path) -> None:
    before = {p.name: p.read_bytes() for p in folder.iterdir()}
    topology = read_topology(folder)
    store_labels(label_node(topology, topology.nodes[0].id, "Küche"), folder)
    assert read_model(folder).topology.nodes[0].label == "Küche"
    changed = {p.name for p in folder.iterdir() if p.read_bytes() != before.get(p.name)}
    assert changed <= {"topology.json", "rooms.png"}


@pytest.mark.parametrize("name", ["topology.json", "map.yaml", "map.pgm", "regions.png"])
def test_a_missing_file_is_named(folder: Path, name: str) -> None:
    (folder / name).unlink()
    with pytest.raises(EchoRoomsError, match=name.replace(".", r"\.")):
        read_model(folder)


def test_a_topology_that_names_a_region_that_is_not_there_is_refused(folder: Path) -> None:
    content = json.loads((folder / "topology.json").read_text())
    content["nodes"][0]["region"] = 99
    (folder / "topology.json").write_text(json.dumps(content))
    with pytest.raises(ModelError, match="99"):
        read_model(folder)


def test_the_drive_before_its_correction_is_kept(model: Model, folder: Path) -> None:
    kept = read_model(folder).drift

    assert kept is not None
    assert model.drift is not None
    assert kept.odometry_map == model.drift.odometry_map
    assert kept.report["edits"] == {
        "rejected": [], "accepted": [], "same_places": [], "dragged": []
    }  # fmt: skip
    with Image.open(folder / "odometry_map.png") as picture:
        assert picture.size[::-1] == tuple(kept.report["odometry_map"]["shape"])
