"""Localizations over HTTP."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from fastapi.testclient import TestClient


@pytest.fixture
def made(
    client: TestClient,
    upload: Callable[..., dict[str, Any]],
    make_model: Callable[..., str],
    wait_for_job: Callable[..., dict[str, Any]],
) -> dict[str, str]:
    """A model, a log, and a finished localization of the log in the model."""
    log_id = upload(client)["id"]
    model_id = make_model(client, log_id, regions=2)
    answer = client.post("/api/localizations", json={"model_id": model_id, "log_id": log_id})
    assert answer.status_code == 202, answer.text
    job = wait_for_job(client, answer.json()["job_id"])
    assert job["status"] == "done", job
    return {"id": answer.json()["id"], "model_id": model_id, "log_id": log_id}


def test_every_step_tells_probabilities_that_sum_to_one(
    client: TestClient, made: dict[str, str]
) -> None:
    summary = client.get(f"/api/localizations/{made['id']}").json()
    steps = client.get(f"/api/localizations/{made['id']}/steps").json()
    assert summary["status"] == "done"
    assert summary["steps"] == len(steps) > 0
    nodes = {node["id"] for node in client.get(f"/api/models/{made['model_id']}").json()["nodes"]}
    for step in steps:
        assert set(step["probabilities"]) == nodes
        assert sum(step["probabilities"].values()) + step["unknown"] == pytest.approx(1, abs=1e-3)
        assert 0 <= step["entropy"] <= 1
        assert step["best"] in nodes


def test_a_log_in_use_stays_and_a_deleted_model_takes_its_localizations_along(
    client: TestClient, made: dict[str, str]
) -> None:
    listed = client.get("/api/localizations", params={"model_id": made["model_id"]}).json()
    assert [item["id"] for item in listed] == [made["id"]]
    assert client.delete(f"/api/logs/{made['log_id']}").status_code == 409
    assert client.delete(f"/api/models/{made['model_id']}").status_code == 204
    assert client.get(f"/api/localizations/{made['id']}").status_code == 404
    assert client.delete(f"/api/logs/{made['log_id']}").status_code == 204


def test_a_deleted_localization_is_gone(client: TestClient, made: dict[str, str]) -> None:
    assert client.delete(f"/api/localizations/{made['id']}").status_code == 204
    assert client.get(f"/api/localizations/{made['id']}/steps").status_code == 404
    assert client.delete(f"/api/localizations/{made['id']}").status_code == 404


@pytest.mark.parametrize(
    "body",
    [
        {"model_id": "gone", "log_id": "gone"},
        {"model_id": "gone"},
        {"model_id": "x", "log_id": "y", "method": "magic"},
        {"model_id": "x", "log_id": "y", "step": 0},
    ],
)
def test_what_cannot_be_localized_is_422(client: TestClient, body: dict[str, Any]) -> None:
    answer = client.post("/api/localizations", json=body)
    assert answer.status_code == 422
    assert answer.headers["content-type"] == "application/problem+json"
