"""Scans that are confirmed are safe, and a finished session is an ordinary log with its model."""

from __future__ import annotations

import contextlib
import json
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx2
import numpy as np
import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.cli import run
from app.live.recording import Recording
from app.live.robot_client import RobotClient
from app.live.session import MOST_TOLD
from core.log_readers import read_log

MakeLog = Callable[..., bytes]
StartServer = Callable[[], Any]


def lines_of(log: bytes) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    header, *scans = (json.loads(line) for line in log.splitlines())
    return header, scans


def socket_to(client: TestClient, path: str) -> Any:
    return client.websocket_connect(f"ws://127.0.0.1:8000{path}")


def begin(client: Any, header: dict[str, Any], **more: Any) -> dict[str, Any]:
    answer = client.post("/api/live", json={"mode": "mapping", "header": header, **more})
    assert answer.status_code == 201, answer.text
    session: dict[str, Any] = answer.json()
    return session


def ended(client: Any, session_id: str, seconds: float = 60) -> dict[str, Any]:
    deadline = time.monotonic() + seconds
    while (session := client.get(f"/api/live/{session_id}").json())["status"] != "ended":
        assert time.monotonic() < deadline, session
        time.sleep(0.05)
    return dict(session)


def test_scans_are_confirmed_with_the_time_of_the_last_and_their_number(
    client: TestClient, make_log: MakeLog
) -> None:
    header, scans = lines_of(make_log(scans=10))
    path = f"/api/live/{begin(client, header)['id']}"
    assert client.post(f"{path}/scans", json=scans[:4]).json() == {
        "ack": 0.75,
        "stored": 4,
        "duplicates": 0,
    }
    with socket_to(client, f"{path}/scans") as robot:
        robot.send_json(scans[4])
        assert robot.receive_json() == {"ack": 1.0, "stored": 5, "duplicates": 0}
        robot.send_json(scans[3:7])
        assert robot.receive_json() == {"ack": 1.5, "stored": 7, "duplicates": 2}
    session = client.get(path).json()
    assert (session["status"], session["stored"], session["last_t"]) == ("running", 7, 1.5)


def test_a_wrong_message_is_answered_with_an_error_and_the_robot_goes_on(
    client: TestClient, make_log: MakeLog
) -> None:
    header, scans = lines_of(make_log(scans=4))
    path = f"/api/live/{begin(client, header)['id']}/scans"
    wrong = [
        "",
        "{",
        '{"t": 1}',
        "[" * 100_000,
        "17",
        '{"t": 1e999, "odom": [0, 0, 0], "ranges": []}',
        json.dumps([scans[0], {**scans[1], "ranges": [1.0]}]),
    ]
    with socket_to(client, path) as robot:
        for text in wrong:
            robot.send_text(text)
            answer = robot.receive_json()
            assert answer["error"]
            assert (answer["ack"], answer["stored"]) == (None, 0)
        robot.send_bytes(b"\xff\xfe{")
        assert "error" in robot.receive_json()
        robot.send_json(scans)
        assert robot.receive_json()["stored"] == 4
    refused = client.post(path, json=[{"t": 9, "odom": [0, 0], "ranges": []}])
    assert refused.status_code == 422
    assert "odom must be [x, y, heading]" in refused.json()["detail"]


def test_a_wrong_header_or_model_begins_nothing(client: TestClient, make_log: MakeLog) -> None:
    header, _ = lines_of(make_log(scans=1))
    assert client.post("/api/live", json={"header": {"format": "x"}}).status_code == 422
    body = {"mode": "localization", "header": header}
    assert client.post("/api/live", json=body).status_code == 422
    assert client.post("/api/live", json={**body, "model_id": "none"}).status_code == 422
    assert client.get("/api/live").json() == []


def test_a_session_that_is_not_there_is_said_to_be_so(client: TestClient) -> None:
    assert client.get("/api/live/none").status_code == 404
    assert client.post("/api/live/none/scans", json=[]).status_code == 404
    with socket_to(client, "/api/live/none/scans") as robot:
        with pytest.raises(WebSocketDisconnect) as closed:
            robot.receive_json()
        assert closed.value.code == 4404


def test_a_finished_session_is_the_log_that_was_streamed_and_its_model(
    client: TestClient, make_log: MakeLog, wait_for_job: Callable[..., dict[str, Any]]
) -> None:
    header, scans = lines_of(make_log(scans=80))
    session = begin(client, header)
    path = f"/api/live/{session['id']}"
    with socket_to(client, f"{path}/events") as page:
        client.post(f"{path}/scans", json=scans)
        told = [page.receive_json() for _ in range(MOST_TOLD)]
        assert {event["type"] for event in told} == {"pose"}
        assert [event["t"] for event in told] == [scan["t"] for scan in scans[-MOST_TOLD:]]
        assert (told[-1]["pose"], told[-1]["ranges"]) == (scans[-1]["odom"], scans[-1]["ranges"])
        assert told[-1]["stored"] == len(scans)
        assert client.delete(path).status_code == 202
        kinds = []
        while not kinds or kinds[-1] != "ended":
            kinds.append(page.receive_json()["type"])
    assert ended(client, session["id"])["stored"] == 80
    log = client.get(f"/api/logs/{session['log_id']}").json()
    assert (log["scans"], log["name"]) == (80, "square room")
    model = client.get(f"/api/models/{session['model_id']}").json()
    assert wait_for_job(client, model["job_id"])["status"] == "done"
    model = client.get(f"/api/models/{session['model_id']}").json()
    assert model["log_ids"] == [session["log_id"]]
    assert sum(node["area_m2"] for node in model["nodes"]) == pytest.approx(16, rel=0.2)
    assert client.post(f"{path}/scans", json=scans[:1]).status_code == 409


def test_the_model_grows_while_the_robot_drives(client: TestClient, make_log: MakeLog) -> None:
    header, scans = lines_of(make_log(scans=80))
    session = begin(client, header)
    path = f"/api/live/{session['id']}"
    with socket_to(client, f"{path}/events") as page:
        client.post(f"{path}/scans", json=scans[:60])
        event = page.receive_json()
        while event["type"] != "nodes":
            event = page.receive_json()
    assert event["model_id"] == session["model_id"]
    model = client.get(f"/api/models/{session['model_id']}").json()
    assert model["revision"] >= event["revision"] >= 1
    assert len(model["nodes"]) == event["nodes"] >= 1


def test_a_line_that_a_crash_cut_is_removed_and_the_recording_goes_on(
    tmp_path: Path, make_log: MakeLog
) -> None:
    header, scans = lines_of(make_log(scans=5))
    path = tmp_path / "log.jsonl"
    Recording.create(path, header).append(scans[:3])
    whole = path.read_bytes()
    path.write_bytes(whole + json.dumps(scans[3]).encode()[:30])
    again = Recording(path)
    assert (again.stored, again.last_t) == (3, scans[2]["t"])
    assert path.read_bytes() == whole
    again.append(scans[3:])
    assert [json.loads(line)["t"] for line in path.read_text().splitlines()[1:]] == [
        scan["t"] for scan in scans
    ]


@pytest.mark.parametrize("kills", [2, pytest.param(20, marks=pytest.mark.slow)])
def test_killed_at_random_moments_nothing_confirmed_is_lost(
    start_server: StartServer, make_log: MakeLog, kills: int
) -> None:
    header, scans = lines_of(make_log(scans=4000))
    server, random = start_server(), np.random.default_rng(kills)
    session = begin(server.http, header)
    path, confirmed = f"/api/live/{session['id']}", -1.0
    for _ in range(kills):
        timer = threading.Timer(random.uniform(0.05, 0.5), server.process.kill)
        timer.start()
        with contextlib.suppress(httpx2.HTTPError):
            while True:
                rest = [scan for scan in scans if scan["t"] > confirmed]
                confirmed = server.http.post(f"{path}/scans", json=rest[:3]).json()["ack"]
        timer.join()
        server.kill()
        server = start_server()
        standing = server.http.get(path).json()
        assert standing["status"] == "running"
        assert (standing["last_t"] or -1.0) >= confirmed
        assert standing["stored"] == sum(scan["t"] <= standing["last_t"] for scan in scans)
    server.http.post(f"{path}/scans", json=scans)
    server.http.delete(path)
    assert ended(server.http, session["id"])["stored"] == len(scans)
    kept = read_log(server.data / "logs" / session["log_id"] / "log.jsonl.gz").log
    np.testing.assert_allclose(kept.t, [scan["t"] for scan in scans], atol=1e-4)
    np.testing.assert_allclose(kept.odometry[:, :2], [s["odom"][:2] for s in scans], atol=1e-4)
    np.testing.assert_allclose(kept.ranges, [scan["ranges"] for scan in scans], atol=1e-3)


def test_the_stream_command_plays_a_log_into_a_session(
    start_server: StartServer, make_log: MakeLog, tmp_path: Path
) -> None:
    server, log = start_server(), tmp_path / "drive.jsonl"
    log.write_bytes(make_log(scans=60))
    assert run(["stream", str(log), server.url, "--speed", "20"]) == 0
    (session,) = server.http.get("/api/live").json()
    assert ended(server.http, session["id"])["stored"] == 60
    assert server.http.get(f"/api/logs/{session['log_id']}").json()["scans"] == 60


def test_a_robot_goes_on_when_the_server_is_killed_and_comes_back(
    start_server: StartServer, make_log: MakeLog
) -> None:
    header, scans = lines_of(make_log(scans=20))
    server = start_server()
    port = int(server.url.rstrip("/").rsplit(":", 1)[1])
    robot = RobotClient(server.url, header, "mapping", None)
    robot.send(scans[:10])
    server.kill()
    again = start_server(port=port)
    robot.send(scans[5:])
    assert (robot.ack, robot.stored) == (scans[-1]["t"], 20)
    assert again.http.get(f"/api/live/{robot.session['id']}").json()["stored"] == 20


def test_a_server_that_is_not_there_is_one_line(
    make_log: MakeLog, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = tmp_path / "drive.jsonl"
    log.write_bytes(make_log(scans=3))
    assert run(["stream", str(log), "http://127.0.0.1:9"]) == 1
    assert run(["stream", str(log), "127.0.0.1"]) == 2
    assert "is no URL" in capsys.readouterr().err
