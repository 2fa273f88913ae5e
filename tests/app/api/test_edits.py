"""Merging, splitting and moving nodes over HTTP, and taking it back."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.events import ModelEvent

WENT_BACK = 60
"""More undos than a test makes edits."""


class Editing:
    """A client that edits one model."""

    def __init__(self, client: TestClient, model_id: str) -> None:
        self.client = client
        self.url = f"/api/models/{model_id}"

    def model(self) -> dict[str, Any]:
        answer: dict[str, Any] = self.client.get(self.url).json()
        return answer

    def post(self, op: str, **fields: Any) -> Any:
        return self.client.post(f"{self.url}/edits", json={"op": op, **fields})

    def undo(self, **body: Any) -> Any:
        return self.client.post(f"{self.url}/undo", json=body or None)

    def redo(self) -> Any:
        return self.client.post(f"{self.url}/redo")

    def part_rooms(self) -> None:
        """Makes every node a room of its own, whatever the program has suggested."""
        while shared := [room for room in self.model()["rooms"] if len(room["nodes"]) > 1]:
            assert self.post("move", node=shared[0]["nodes"][0], room=None).status_code == 200

    def line_through(self, node: dict[str, Any]) -> list[list[float]]:
        """A line through the middle of a node, far beyond the walls, across the room's middle."""
        x, y = node["position"]
        reach = 6 / math.hypot(x, y)
        return [[x * (1 - reach), y * (1 - reach)], [x * (1 + reach), y * (1 + reach)]]


@pytest.fixture
def editing(shared_client: TestClient, shared_model: str) -> Iterator[Editing]:
    """Edits of the shared model, all taken back at the end."""
    editing = Editing(shared_client, shared_model)
    before = editing.model()
    yield editing
    for _ in range(WENT_BACK):
        if editing.undo().status_code == 409:
            break
    for kind in ("nodes", "edges", "rooms"):
        assert [item["id"] for item in editing.model()[kind]] == [
            item["id"] for item in before[kind]
        ]


def topology(model: dict[str, Any]) -> dict[str, Any]:
    return {kind: model[kind] for kind in ("nodes", "edges", "rooms")}


def test_a_merge_is_made_told_in_words_undone_and_redone(editing: Editing) -> None:
    before = editing.model()
    edge = before["edges"][0]
    answer = editing.post("merge", nodes=[edge["source"], edge["target"]])
    assert answer.status_code == 200
    merged = answer.json()
    assert len(merged["nodes"]) == 2
    (node,) = [n for n in merged["nodes"] if n["came_from"]]
    assert set(node["came_from"]) == {edge["source"], edge["target"]}
    assert (merged["can_undo"], merged["can_redo"]) == (True, False)
    assert merged["last_edit"].startswith("merged Region")
    undone = editing.undo().json()
    assert topology(undone) == topology(before)
    assert undone["can_redo"]
    assert undone["undone_edit"] == merged["last_edit"]
    assert topology(editing.redo().json()) == topology(merged)
    assert editing.model()["revision"] == before["revision"] + 3


def test_a_split_gives_two_nodes_of_one_room(editing: Editing) -> None:
    before = editing.model()
    node = before["nodes"][0]
    split = editing.post("split", node=node["id"], line=editing.line_through(node)).json()
    pieces = [n for n in split["nodes"] if n["came_from"] == [node["id"]]]
    assert len(pieces) == 2
    assert sum(n["area_m2"] for n in pieces) == pytest.approx(node["area_m2"], abs=0.002)
    assert len(split["rooms"]) == len(before["rooms"])


def test_a_node_moves_to_the_room_of_its_neighbour_and_out_again(editing: Editing) -> None:
    editing.part_rooms()
    model = editing.model()
    edge = model["edges"][0]
    (room,) = [r for r in model["rooms"] if edge["target"] in r["nodes"]]
    moved = editing.post("move", node=edge["source"], room=room["id"]).json()
    (joined,) = [r for r in moved["rooms"] if r["id"] == room["id"]]
    assert set(joined["nodes"]) == {edge["source"], edge["target"]}
    alone = editing.post("move", node=edge["source"], room=None).json()
    assert len(alone["rooms"]) == len(model["rooms"])


def test_a_name_can_be_undone(editing: Editing) -> None:
    url = f"{editing.url}/nodes/{editing.model()['nodes'][0]['id']}"
    named = editing.client.patch(url, json={"label": "hall"}).json()
    assert named["last_edit"] == "named Region 1 “hall”"
    assert editing.undo(revision=named["revision"]).json()["labels"] == []


def test_what_geometry_forbids_is_422_and_says_why(editing: Editing) -> None:
    before = editing.model()
    node = before["nodes"][0]
    answer = editing.post("split", node=node["id"], line=[[90, 90], [91, 91]])
    assert answer.status_code == 422
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.json()["detail"] == "the line misses Region 1: draw it across the region"
    assert editing.model() == before


@pytest.mark.parametrize(
    "body",
    [
        {},
        {"op": "paint", "node": "n1"},
        {"op": "merge", "nodes": []},
        {"op": "merge", "nodes": ["n1"]},
        {"op": "merge", "nodes": ["n1", "nope"]},
        {"op": "merge", "nodes": ["n1", "n1"]},
        {"op": "split", "node": "n1", "line": []},
        {"op": "split", "node": "n1", "line": [[0, 0]]},
        {"op": "split", "node": "n1", "line": [[0, 0], [0, 1e300]]},
        {"op": "split", "node": "n1", "line": [[0, 0], [0, "a"]]},
        {"op": "split", "node": "n1", "line": [[0, 0, 0], [0, 1, 0]]},
        {"op": "split", "node": "nope", "line": [[0, 0], [0, 1]]},
        {"op": "move", "node": "n1"},
        {"op": "move", "node": "n1", "room": "nope"},
        {"op": "move", "node": "n1", "room": None},
    ],
)
def test_an_edit_that_cannot_be_is_422_and_changes_nothing(
    editing: Editing, body: dict[str, Any]
) -> None:
    editing.part_rooms()
    before = editing.model()
    answer = editing.client.post(f"{editing.url}/edits", json=body)
    assert answer.status_code == 422, answer.text
    assert answer.json()["detail"]
    assert editing.model() == before


def test_an_unknown_model_is_404(shared_client: TestClient) -> None:
    body = {"op": "merge", "nodes": ["n1", "n2"]}
    for path, content in (("edits", body), ("undo", None), ("redo", None)):
        answer = shared_client.post(f"/api/models/nope/{path}", json=content)
        assert answer.status_code == 404


def test_nothing_to_undo_and_an_old_revision_are_409(editing: Editing) -> None:
    assert not editing.model()["can_undo"]
    assert editing.undo().status_code == 409
    model = editing.model()
    editing.post("merge", nodes=[model["edges"][0]["source"], model["edges"][0]["target"]])
    stale = editing.undo(revision=model["revision"])
    assert stale.status_code == 409
    assert stale.json()["detail"] == "the model has changed since"


def test_every_edit_and_undo_is_told_to_who_shows_the_model(editing: Editing) -> None:
    heard: list[ModelEvent] = []
    events = editing.client.app.state.events  # type: ignore[attr-defined]
    unsubscribe = events.subscribe(lambda event, model_id: heard.append(event))
    edge = editing.model()["edges"][0]
    editing.post("merge", nodes=[edge["source"], edge["target"]])
    editing.undo()
    editing.redo()
    unsubscribe()
    assert heard == [ModelEvent.CHANGED] * 3


def test_while_a_job_makes_the_model_anew_edits_are_409(
    client: TestClient,
    upload: Callable[..., Any],
    make_model: Callable[..., str],
    make_log: Callable[..., bytes],
    wait_for_job: Callable[..., dict[str, Any]],
) -> None:
    editing = Editing(client, make_model(client))
    later = upload(client, make_log(start_t=100.0))
    job = client.post(f"{editing.url}/logs", json={"log_id": later["id"]}).json()["job_id"]
    refused = editing.post("merge", nodes=["n1", "n2"])
    assert refused.status_code == 409
    assert "being made" in refused.json()["detail"]
    wait_for_job(client, job)
    edge = editing.model()["edges"][0]
    assert editing.post("merge", nodes=[edge["source"], edge["target"]]).status_code == 200
