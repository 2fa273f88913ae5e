"""The timeline of a model over HTTP."""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient
from PIL import Image


@pytest.fixture(scope="module")
def driven(
    shared_client: TestClient,
    upload: Callable[..., dict[str, Any]],
    wait_for_job: Callable[..., dict[str, Any]],
) -> str:
    """The address of a model that was made along a drive."""
    log = upload(shared_client)["id"]
    accepted = shared_client.post("/api/models", json={"log_id": log, "odometry": "raw"}).json()
    assert wait_for_job(shared_client, accepted["job_id"])["status"] == "done"
    return f"/api/models/{accepted['id']}"


def test_the_timeline_tells_every_step_with_its_decisions(
    shared_client: TestClient, driven: str
) -> None:
    moments = shared_client.get(f"{driven}/timeline").json()
    assert [moment["step"] for moment in moments] == list(range(len(moments)))
    assert moments[0]["thresholds"]["hidden_pairs"] == 0.23
    last = next(m for m in moments if m["said"].startswith("end of the drive"))
    assert last["decisions"][0]["accepted"]
    assert len(last["decisions"][0]["hull"]) >= 3


def test_the_picture_of_a_step_is_as_large_as_the_grid(
    shared_client: TestClient, driven: str
) -> None:
    answer = shared_client.get(f"{driven}/timeline/0.png")
    assert answer.headers["content-type"] == "image/png"
    step = Image.open(io.BytesIO(answer.content))
    grid = Image.open(io.BytesIO(shared_client.get(f"{driven}/grid.png").content))
    assert step.size == grid.size
    assert set(np.unique(np.asarray(step)[..., 0] % 4)) == {0, 1, 2}


def test_the_timeline_survives_edits_and_undo(shared_client: TestClient, driven: str) -> None:
    def both() -> tuple[Any, bytes]:
        moments = shared_client.get(f"{driven}/timeline").json()
        return moments, shared_client.get(f"{driven}/timeline/{len(moments) - 1}.png").content

    before = both()
    node = shared_client.get(driven).json()["nodes"][0]["id"]
    edit = {"op": "split", "node": node, "line": [[-3, 0.1], [3, 0.1]]}
    assert shared_client.post(f"{driven}/edits", json=edit).status_code == 200
    assert both() == before
    assert shared_client.post(f"{driven}/undo").status_code == 200
    assert both() == before


def test_a_step_that_is_not_there_is_not_found(shared_client: TestClient, driven: str) -> None:
    assert shared_client.get(f"{driven}/timeline/999.png").status_code == 404
    assert shared_client.get(f"{driven}/timeline/-1.png").status_code == 422
    assert shared_client.get("/api/models/nothing/timeline").status_code == 404


def test_a_model_with_the_number_of_regions_given_has_no_timeline(
    shared_client: TestClient, shared_model: str
) -> None:
    assert shared_client.get(f"/api/models/{shared_model}/timeline").json() == []
    assert shared_client.get(f"/api/models/{shared_model}/timeline/0.png").status_code == 404
