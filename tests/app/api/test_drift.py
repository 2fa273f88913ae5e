"""What a person says about the drift of a drive, over HTTP."""

from __future__ import annotations

import gzip
import io
from collections.abc import Callable
from typing import Any

import pytest
from fastapi.testclient import TestClient
from PIL import Image

from core.log_readers.native import write_native
from core.simulation import DriveConfig, simulate

Wait = Callable[..., dict[str, Any]]


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A drive that comes back to where it began, with bad odometry."""
    config = DriveConfig(mapping_length=30.0)
    log = simulate("paper", seed=3, odometry="bad", config=config).slice(0, 900)
    path = tmp_path_factory.mktemp("log") / "drive.jsonl.gz"
    write_native(log, path)
    return gzip.decompress(path.read_bytes())


@pytest.fixture(scope="module")
def model(
    shared_client: TestClient,
    upload: Callable[..., dict[str, Any]],
    make_model: Callable[..., str],
    drive: bytes,
) -> str:
    """The address of a model of the drive."""
    log = upload(shared_client, drive)["id"]
    return f"/api/models/{make_model(shared_client, log, regions=4)}"


def say(client: TestClient, model: str, wait: Wait, **body: object) -> dict[str, Any]:
    """Says something, waits for the model, and returns its drift."""
    accepted = client.post(f"{model}/drift/edits", json=body)
    assert accepted.status_code == 202, accepted.text
    assert wait(client, accepted.json()["job_id"])["status"] == "done"
    drift: dict[str, Any] = client.get(f"{model}/drift").json()
    return drift


def judged(drift: dict[str, Any], closure: str) -> tuple[bool, bool]:
    found = next(item for item in drift["closures"] if item["id"] == closure)
    return found["accepted"], found["by_person"]


def test_the_drift_is_told_with_the_drive_before_and_after(
    shared_client: TestClient, model: str
) -> None:
    drift = shared_client.get(f"{model}/drift").json()

    assert drift["used"] == "corrected"
    assert any("found again" in sentence for sentence in drift["sentences"])
    assert drift["calibration"]["turn_scale_sigma"] > 0
    assert any(closure["accepted"] for closure in drift["closures"])
    assert drift["trajectory"][0][1:4] == pytest.approx(drift["trajectory"][0][4:], abs=1e-3)
    picture = Image.open(io.BytesIO(shared_client.get(f"{model}/drift/odometry.png").content))
    assert list(picture.size[::-1]) == drift["odometry_map"]["shape"]


def test_a_closure_is_rejected_undone_and_redone(
    shared_client: TestClient, model: str, wait_for_job: Wait
) -> None:
    before = shared_client.get(f"{model}/drift").json()
    nodes = shared_client.get(model).json()["nodes"]
    node = nodes[0]["id"]
    shared_client.patch(f"{model}/nodes/{node}", json={"label": "kitchen"})
    wrong = next(closure["id"] for closure in before["closures"] if closure["accepted"])

    after = say(shared_client, model, wait_for_job, op="reject", closure=wrong)

    assert judged(after, wrong) == (False, True)
    assert after["trajectory"] != before["trajectory"]
    detail = shared_client.get(model).json()
    assert "kitchen" in detail["labels"]
    assert node in {item["id"] for item in detail["nodes"]}
    assert detail["last_edit"] == "rejected a place found again"
    shared_client.post(f"{model}/undo")
    back = shared_client.get(f"{model}/drift").json()
    assert back | {"revision": 0} == before | {"revision": 0}
    shared_client.post(f"{model}/redo")
    assert judged(shared_client.get(f"{model}/drift").json(), wrong) == (False, True)
    again = say(shared_client, model, wait_for_job, op="forget", closure=wrong)
    assert again["trajectory"] == before["trajectory"]


def test_a_stretch_is_dragged_and_all_is_taken_back(
    shared_client: TestClient, model: str, wait_for_job: Wait
) -> None:
    before = shared_client.get(f"{model}/drift").json()
    t, x, y = before["trajectory"][len(before["trajectory"]) // 2][:3]

    after = say(shared_client, model, wait_for_job, op="drag", t=t, x=x + 0.5, y=y)

    there = next(row for row in after["trajectory"] if row[0] == t)
    assert there[1] == pytest.approx(x + 0.5, abs=0.25)
    taken_back = shared_client.delete(f"{model}/drift/edits")
    assert wait_for_job(shared_client, taken_back.json()["job_id"])["status"] == "done"
    assert shared_client.get(f"{model}/drift").json()["trajectory"] == before["trajectory"]


def test_one_edit_of_several_is_taken_back_at_any_time(
    shared_client: TestClient, model: str, wait_for_job: Wait
) -> None:
    before = shared_client.get(f"{model}/drift").json()
    rows = before["trajectory"]
    t, x, y = rows[len(rows) // 2][:3]
    ends = {"t_source": rows[5][0], "t_target": rows[-5][0]}
    say(shared_client, model, wait_for_job, op="same_place", **ends)
    said = say(shared_client, model, wait_for_job, op="drag", t=t, x=x + 0.5, y=y)
    assert said["edits"]["same_places"] == [ends]

    parted = say(shared_client, model, wait_for_job, op="forget_same_place", **ends)

    assert parted["edits"]["same_places"] == []
    assert [item["t"] for item in parted["edits"]["dragged"]] == [t]
    left = say(shared_client, model, wait_for_job, op="forget_drag", t=t)
    assert left["trajectory"] == before["trajectory"]
    again = shared_client.post(f"{model}/drift/edits", json={"op": "forget_drag", "t": t})
    assert again.status_code == 422
    assert "nobody dragged the drive" in again.json()["detail"]


def test_what_cannot_be_fails_and_leaves_the_model_alone(
    shared_client: TestClient, model: str, wait_for_job: Wait
) -> None:
    before = shared_client.get(f"{model}/drift").json()

    body = {"op": "same_place", "t_source": 1.0, "t_target": 1e6}
    job = shared_client.post(f"{model}/drift/edits", json=body).json()["job_id"]

    ended = wait_for_job(shared_client, job)
    assert ended["status"] == "failed"
    assert "outside of the drive" in ended["error"]
    assert shared_client.get(f"{model}/drift").json() == before
    assert shared_client.get(model).json()["status"] == "done"


@pytest.mark.parametrize(
    "body",
    [
        {},
        {"op": "reject"},
        {"op": "reject", "closure": "../../etc/passwd"},
        {"op": "drag", "t": 1.0, "x": "NaN", "y": 0.0},
        {"op": "same_place", "t_source": 1.0},
    ],
)
def test_nonsense_is_refused(shared_client: TestClient, model: str, body: object) -> None:
    assert shared_client.post(f"{model}/drift/edits", json=body).status_code == 422


def test_a_model_of_raw_odometry_has_nothing_to_correct(
    shared_client: TestClient, upload: Callable[..., dict[str, Any]], wait_for_job: Wait
) -> None:
    body = {"log_id": upload(shared_client)["id"], "regions": 2, "odometry": "raw"}
    made = shared_client.post("/api/models", json=body).json()
    wait_for_job(shared_client, made["job_id"])

    said = {"op": "same_place", "t_source": 1.0, "t_target": 9.0}
    answer = shared_client.post(f"/api/models/{made['id']}/drift/edits", json=said)

    assert answer.status_code == 422
    assert "no corrected drive" in answer.json()["detail"]


def test_a_robots_calibration_is_kept_and_used_for_its_next_log(
    client: TestClient,
    upload: Callable[..., dict[str, Any]],
    make_model: Callable[..., str],
    wait_for_job: Wait,
    drive: bytes,
) -> None:
    log = upload(client, drive)["id"]
    unknown = client.post("/api/models", json={"log_id": log, "calibration": "robot"})
    assert unknown.status_code == 422
    first = f"/api/models/{make_model(client, log, regions=3)}"

    kept = client.put(f"{first}/drift/calibration").json()

    told = client.get(f"/api/logs/{log}").json()["robot"]
    assert told["calibration"] == kept["calibration"]
    body = {"log_id": log, "regions": 3, "calibration": "robot"}
    made = client.post("/api/models", json=body).json()
    assert wait_for_job(client, made["job_id"])["status"] == "done"
    drift = client.get(f"/api/models/{made['id']}/drift").json()
    assert any("earlier drive" in sentence for sentence in drift["sentences"])
    assert drift["calibration"]["turn_scale_sigma"] <= kept["calibration"]["turn_scale_sigma"]
    assert client.delete(f"{first}/drift/calibration").status_code == 204
    assert client.get(f"/api/logs/{log}").json()["robot"] is None
