"""Naming nodes and rooms over HTTP."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.events import ModelEvent


class Naming:
    """A client that names things in one model."""

    def __init__(self, client: TestClient, model_id: str) -> None:
        self.client = client
        self.url = f"/api/models/{model_id}"

    def model(self) -> dict[str, Any]:
        answer: dict[str, Any] = self.client.get(self.url).json()
        return answer

    def node(self, node_id: str, label: Any) -> Any:
        return self.client.patch(f"{self.url}/nodes/{node_id}", json={"label": label})

    def room(self, room_id: str, label: Any) -> Any:
        return self.client.patch(f"{self.url}/rooms/{room_id}", json={"label": label})


@pytest.fixture
def naming(shared_client: TestClient, shared_model: str) -> Iterator[Naming]:
    """Names in the shared model, which has none afterwards."""
    naming = Naming(shared_client, shared_model)
    yield naming
    for node in naming.model()["nodes"]:
        if node["label"]:
            naming.node(node["id"], None)


def test_a_label_is_trimmed_stored_and_found(naming: Naming) -> None:
    node = naming.model()["nodes"][1]
    answer = naming.node(node["id"], "  kitchen ")
    assert answer.status_code == 200
    assert answer.json()["nodes"][1] == node | {"label": "kitchen"}
    assert naming.model()["labels"] == ["kitchen"]
    found = naming.client.get("/api/models?q=KITCH").json()
    assert naming.model()["id"] in [model["id"] for model in found]


def test_null_and_blanks_take_a_label_away(naming: Naming) -> None:
    node_id = naming.model()["nodes"][0]["id"]
    for nothing in (None, "", "   "):
        naming.node(node_id, "hall")
        assert naming.node(node_id, nothing).json()["nodes"][0]["label"] is None
        assert naming.model()["labels"] == []


@pytest.mark.parametrize("label", ["a\x07b", "two\nlines", "x" * 81, 7, ["a"], "a\u202eb"])
def test_a_label_that_cannot_be_is_422_and_changes_nothing(naming: Naming, label: Any) -> None:
    before = naming.model()
    assert naming.node(before["nodes"][0]["id"], label).status_code == 422
    assert naming.model() == before


@pytest.mark.parametrize(
    "label", ["Küche", "寝室", "👶 room", "<script>alert(1)</script>", "x" * 80]
)
def test_any_printable_label_up_to_80_characters_is_kept(naming: Naming, label: str) -> None:
    node_id = naming.model()["nodes"][0]["id"]
    assert naming.node(node_id, label).status_code == 200
    assert naming.model()["nodes"][0]["label"] == label


def test_touching_nodes_of_one_label_become_a_room_and_a_room_names_its_nodes(
    naming: Naming,
) -> None:
    model = naming.model()
    for node in model["nodes"]:
        rooms = naming.node(node["id"], f"room of {node['id']}").json()["rooms"]
    assert len(rooms) == 3
    edge = model["edges"][0]
    naming.node(edge["source"], "living room")
    rooms = naming.node(edge["target"], "living room").json()["rooms"]
    (room,) = [room for room in rooms if room["label"] == "living room"]
    assert set(room["nodes"]) == {edge["source"], edge["target"]}
    assert len(rooms) == 2
    renamed = naming.room(room["id"], "parlour").json()
    labels = {node["id"]: node["label"] for node in renamed["nodes"]}
    assert labels[edge["source"]] == labels[edge["target"]] == "parlour"


def test_an_unknown_node_or_room_is_404(naming: Naming) -> None:
    assert "node" in naming.node("nope", "x").json()["detail"]
    assert naming.node("nope", "x").status_code == 404
    assert naming.room("nope", "x").status_code == 404
    assert naming.node("..%2f..%2f", "x").status_code == 404


def test_a_body_without_a_label_is_422(naming: Naming) -> None:
    url = f"{naming.url}/nodes/{naming.model()['nodes'][0]['id']}"
    assert naming.client.patch(url, json={}).status_code == 422


def test_every_change_is_told_to_who_shows_the_model(naming: Naming) -> None:
    heard: list[tuple[ModelEvent, str]] = []
    events = naming.client.app.state.events  # type: ignore[attr-defined]
    unsubscribe = events.subscribe(lambda event, model_id: heard.append((event, model_id)))
    model = naming.model()
    naming.node(model["nodes"][0]["id"], "hall")
    unsubscribe()
    naming.node(model["nodes"][0]["id"], "hallway")
    assert heard == [(ModelEvent.CHANGED, model["id"])]


def test_labels_given_at_the_same_time_are_all_kept(naming: Naming) -> None:
    nodes = [node["id"] for node in naming.model()["nodes"]]
    threads = [
        threading.Thread(target=naming.node, args=(node_id, f"room {i}"))
        for i, node_id in enumerate(nodes)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [n["label"] for n in naming.model()["nodes"]] == ["room 0", "room 1", "room 2"]
