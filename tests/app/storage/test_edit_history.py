"""Undo and redo of edits on disk, without a server."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.errors import Conflict
from app.events import ModelEvent, ModelEvents
from app.storage.data_folder import DataFolder
from app.storage.database import Database
from app.storage.edit_history import MOST_STEPS, EditHistory
from app.storage.label_edit import node_label
from app.storage.model_facts import facts_of
from app.storage.model_store import ModelStore
from app.storage.shape_edit import merge, move, split
from core.errors import InputError
from core.mapping import GridGeometry, OccupancyGrid
from core.topology import Model
from core.topology.labels import room_image
from core.topology.model_folder import write_model
from core.topology.topology_of import topology_of


def three_rooms() -> Model:
    """Three rooms of 1 m in a row, 0.1 m cells, wide open to each other."""
    regions = np.zeros((12, 32), np.int64)
    for i in range(3):
        regions[1:11, 1 + 10 * i : 11 + 10 * i] = i + 1
    grid = OccupancyGrid.of(
        GridGeometry(0.1, (0.0, 0.0, 0.0), regions.shape), regions > 0, regions == 0
    )
    topology = topology_of(grid, regions)
    return Model(grid, regions, room_image(regions, topology), topology, None, {})


class Home:
    """A store with one finished model."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.folder = DataFolder(root)
        self.folder.open()
        self.database = Database(self.folder.database)
        self.events = ModelEvents()
        self.models = ModelStore(self.database, self.folder, self.events)
        self.id = self.models.add("flat", {}, []).id
        self.publish()

    def publish(self) -> None:
        made = self.folder.temp / "made"
        write_model(three_rooms(), made)
        self.models.publish(self.id, made, [], facts_of(made))

    def bytes(self) -> dict[str, bytes]:
        return {p.name: p.read_bytes() for p in self.models.folder(self.id).iterdir()}

    def topology(self) -> dict[str, Any]:
        content: dict[str, Any] = json.loads(self.bytes()["topology.json"])
        return content

    def ids(self) -> set[str]:
        topology = self.topology()
        return {item["id"] for kind in ("nodes", "edges", "rooms") for item in topology[kind]}

    def node(self, region: int) -> str:
        return str(next(n["id"] for n in self.topology()["nodes"] if n["region"] == region))

    def close(self) -> None:
        self.database.close()
        self.folder.close()


@pytest.fixture
def home(tmp_path: Path) -> Iterator[Home]:
    home = Home(tmp_path / "data")
    yield home
    home.close()


def the_edits(home: Home) -> list[Callable[[], Any]]:
    """One of each kind, to be called in order."""
    across = [(0.55, 0.0), (0.55, 1.2)]
    return [
        lambda: node_label(home.node(2), "kitchen"),
        lambda: split(home.node(1), across),
        lambda: merge([home.node(2), home.node(3)]),
        lambda: move(home.node(4), None),
    ]


def test_undo_and_redo_bring_every_byte_back(home: Home) -> None:
    states = [home.bytes()]
    for edit in the_edits(home):
        home.models.edit(home.id, edit())
        states.append(home.bytes())
    for state in reversed(states[:-1]):
        home.models.undo(home.id)
        assert home.bytes() == state
    with pytest.raises(Conflict, match="nothing to undo"):
        home.models.undo(home.id)
    for state in states[1:]:
        home.models.redo(home.id)
        assert home.bytes() == state
    with pytest.raises(Conflict, match="nothing to redo"):
        home.models.redo(home.id)


def test_the_revision_grows_with_undo_and_redo_and_all_is_told(home: Home) -> None:
    heard: list[tuple[ModelEvent, str]] = []
    home.events.subscribe(lambda event, model_id: heard.append((event, model_id)))
    home.models.edit(home.id, node_label(home.node(1), "hall"))
    assert home.models.undo(home.id).revision == 3
    redone = home.models.redo(home.id)
    assert (redone.revision, redone.labels) == (4, ("hall",))
    assert heard == [(ModelEvent.CHANGED, home.id)] * 3


def test_an_edit_after_an_undo_drops_what_was_undone(home: Home) -> None:
    home.models.edit(home.id, node_label(home.node(1), "hall"))
    home.models.undo(home.id)
    home.models.edit(home.id, node_label(home.node(1), "bath"))
    with pytest.raises(Conflict, match="nothing to redo"):
        home.models.redo(home.id)
    assert home.models.undo(home.id).labels == ()
    folders = {p.name for p in (home.root / "models" / home.id).glob("0*")}
    history = home.models.history(home.id)
    assert history is not None
    assert folders == {f"{number:06d}" for number in history.folders}


def test_ids_of_an_edit_that_was_undone_are_not_given_again(home: Home) -> None:
    before = home.ids()
    home.models.edit(home.id, split(home.node(1), [(0.55, 0.0), (0.55, 1.2)]))
    undone = home.ids() - before
    home.models.undo(home.id)
    home.models.edit(home.id, split(home.node(3), [(2.55, 0.0), (2.55, 1.2)]))
    fresh = home.ids() - before
    assert undone
    assert fresh
    assert not fresh & undone


def test_what_was_done_is_told_in_words(home: Home) -> None:
    for edit in the_edits(home):
        home.models.edit(home.id, edit())
    history = home.models.history(home.id)
    assert history is not None
    assert [step.what for step in history.past] == [
        "named Region 2 “kitchen”",
        "split Region 1",
        "merged kitchen and Region 3",
        "made Region 4 a room of its own",
    ]


def test_an_expected_revision_that_is_not_there_any_more_is_a_conflict(home: Home) -> None:
    first = home.models.edit(home.id, node_label(home.node(1), "hall"))
    home.models.edit(home.id, node_label(home.node(2), "bath"))
    with pytest.raises(Conflict, match="changed since"):
        home.models.undo(home.id, first.revision)
    assert home.models.get(home.id).labels == ("bath", "hall")


def test_shapes_cannot_be_edited_while_a_job_makes_the_model_but_names_can(home: Home) -> None:
    home.models.set_job(home.id, "job")
    for refused in (
        lambda: home.models.edit(home.id, merge([home.node(1), home.node(2)])),
        lambda: home.models.undo(home.id),
        lambda: home.models.redo(home.id),
    ):
        with pytest.raises(Conflict, match="being made"):
            refused()
    named = home.models.edit(home.id, node_label(home.node(1), "hall"), while_made=True)
    assert named.labels == ("hall",)


def test_a_model_that_is_made_again_begins_a_new_history(home: Home) -> None:
    home.models.edit(home.id, node_label(home.node(1), "hall"))
    home.publish()
    with pytest.raises(Conflict, match="nothing to undo"):
        home.models.undo(home.id)
    assert home.models.get(home.id).revision == 3
    assert [p.name for p in (home.root / "models" / home.id).glob("0*")] == ["000003"]


def test_shared_files_of_revisions_take_their_space_once(home: Home) -> None:
    before = home.models.get(home.id).size_bytes
    grid = len(home.bytes()["map.pgm"])
    after = home.models.edit(home.id, node_label(home.node(1), "hall")).size_bytes
    files = ("topology.json", "regions.png", "rooms.png", "history.jsonl")
    copied = sum(len(home.bytes()[name]) for name in files)
    assert before < after < before + copied + grid


def test_the_line_of_edits_is_bounded() -> None:
    history = EditHistory.begin(None)
    for i in range(MOST_STEPS + 10):
        history = history.edited(f"edit {i}")
    assert len(history.past) == MOST_STEPS
    assert history.past[0].what == "edit 10"
    assert len(history.folders) == MOST_STEPS + 1


STEP = st.tuples(
    st.sampled_from(["label", "merge", "split", "move", "undo", "redo", "undo", "redo"]),
    st.integers(0, 9),
    st.floats(0.0, 3.2),
)


@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
@given(steps=st.lists(STEP, min_size=2, max_size=9))
def test_any_line_of_edits_undos_and_redos_leads_through_the_same_states(
    steps: list[tuple[str, int, float]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    home = Home(tmp_path_factory.mktemp("home") / "data")
    states, at = [home.bytes()], 0
    ever = home.ids()
    for what, index, x in steps:
        try:
            if what in ("undo", "redo"):
                turn = home.models.undo if what == "undo" else home.models.redo
                turn(home.id)
                at += -1 if what == "undo" else 1
            else:
                home.models.edit(home.id, step_edit(home, what, index, x))
                del states[at + 1 :]
                states.append(home.bytes())
                at += 1
                new = home.ids() - ids_in(states[at - 1])
                assert not new & ever
                ever |= new
        except (InputError, Conflict):
            pass
        assert home.bytes() == states[at]
    home.close()


def ids_in(state: dict[str, bytes]) -> set[str]:
    topology = json.loads(state["topology.json"])
    return {item["id"] for kind in ("nodes", "edges", "rooms") for item in topology[kind]}


def step_edit(home: Home, what: str, index: int, x: float) -> Any:
    topology = home.topology()
    node = topology["nodes"][index % len(topology["nodes"])]["id"]
    if what == "label":
        return node_label(node, f"room {index}")
    if what == "split":
        return split(node, [(x, 0.0), (x, 1.2)])
    if what == "merge" and topology["edges"]:
        edge = topology["edges"][index % len(topology["edges"])]
        return merge([edge["source"], edge["target"]])
    rooms = [room["id"] for room in topology["rooms"]]
    return move(node, [*rooms, None][index % (len(rooms) + 1)])
