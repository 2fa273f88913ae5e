"""What is recorded is mapped, modelled or localized as it comes, whatever happens to a worker."""

from __future__ import annotations

import json
import os
import signal
import time
from collections.abc import Callable
from typing import Any

import psutil
import pytest
from fastapi.testclient import TestClient

from core.log_readers.native import header_of, write_native
from core.log_readers.native_line import scan_record
from core.sensing import RobotLog
from core.simulation import simulate

PATIENCE_S = 120


@pytest.fixture(scope="module")
def drive() -> RobotLog:
    return simulate("paper", seed=4).without_truth().slice(0, 260)


def begin(client: TestClient, log: RobotLog, **body: Any) -> str:
    body = {"mode": "mapping", "header": header_of(log)} | body
    answer = client.post("/api/live", json=body)
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


def send(client: TestClient, session: str, log: RobotLog) -> None:
    scans = [scan_record(scan) for scan in log]
    assert client.post(f"/api/live/{session}/scans", json=scans).status_code == 200


def events_until(socket: Any, kind: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = []
    end = time.monotonic() + PATIENCE_S
    while not found or found[-1]["type"] != kind:
        assert time.monotonic() < end
        found.append(json.loads(socket.receive_text()))
    return found


def live_workers() -> list[psutil.Process]:
    children = psutil.Process().children(recursive=True)
    return [p for p in children if "app.live.worker" in p.cmdline()]


def test_a_mapping_session_tells_of_its_map_and_its_nodes(
    client: TestClient, drive: RobotLog
) -> None:
    session = begin(client, drive)
    with client.websocket_connect(f"ws://127.0.0.1:8000/api/live/{session}/events") as events:
        send(client, session, drive)
        told = events_until(events, "nodes")
    assert [e["type"] for e in told if e["type"] in ("map", "nodes")] == ["map", "nodes"]
    taken = [e for e in told if e["type"] == "taken_in"]
    assert taken[-1]["t"] == pytest.approx(drive.t[-1], abs=1e-3)
    model = client.get(f"/api/models/{told[-1]['model_id']}").json()
    assert model["status"] == "done"
    assert model["nodes"]
    assert model["revision"] == told[-1]["revision"]


def test_names_given_while_the_robot_drives_stick(client: TestClient, drive: RobotLog) -> None:
    session = begin(client, drive)
    with client.websocket_connect(f"ws://127.0.0.1:8000/api/live/{session}/events") as events:
        send(client, session, drive.slice(0, 150))
        model = events_until(events, "nodes")[-1]["model_id"]
        node = client.get(f"/api/models/{model}").json()["nodes"][0]["id"]
        client.patch(f"/api/models/{model}/nodes/{node}", json={"label": "kitchen"})
        send(client, session, drive.slice(150, 260))
        events_until(events, "nodes")
    nodes = client.get(f"/api/models/{model}").json()["nodes"]
    assert {n["id"]: n["label"] for n in nodes}[node] == "kitchen"


def test_a_session_goes_on_after_its_worker_was_killed(client: TestClient, drive: RobotLog) -> None:
    session = begin(client, drive)
    with client.websocket_connect(f"ws://127.0.0.1:8000/api/live/{session}/events") as events:
        send(client, session, drive.slice(0, 100))
        events_until(events, "taken_in")
        for worker in live_workers():
            os.kill(worker.pid, signal.SIGKILL)
        send(client, session, drive.slice(100, 260))
        told = events_until(events, "nodes")
    assert told[-1]["t"] == pytest.approx(drive.t[-1], abs=1e-3)


def test_a_localization_session_tells_the_room_and_its_name(
    client: TestClient,
    drive: RobotLog,
    tmp_path: Any,
    upload: Callable[..., dict[str, Any]],
    wait_for_job: Callable[..., dict[str, Any]],
) -> None:
    path = tmp_path / "drive.jsonl"
    write_native(drive, path)
    log = upload(client, path.read_bytes())["id"]
    body = {"log_id": log, "mode": "offline", "regions": 2, "odometry": "raw"}
    made = client.post("/api/models", json=body).json()
    assert wait_for_job(client, made["job_id"])["status"] == "done"
    for node in client.get(f"/api/models/{made['id']}").json()["nodes"]:
        client.patch(f"/api/models/{made['id']}/nodes/{node['id']}", json={"label": "hall"})
    session = begin(client, drive, mode="localization", model_id=made["id"])
    with client.websocket_connect(f"ws://127.0.0.1:8000/api/live/{session}/events") as events:
        send(client, session, drive)
        belief = events_until(events, "belief")[-1]
    assert belief["label"] == "hall"
    assert belief["current_room"] in belief["probabilities"]
    total = sum(belief["probabilities"].values()) + belief["unknown"]
    assert total == pytest.approx(1, abs=1e-3)
