"""A simulated robot is a client of the live API like any other, and leaves a log and a model."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import httpx2
import pytest
from fastapi.testclient import TestClient

StartServer = Callable[..., Any]
PATIENCE_S = 120


def wait_for(ask: Callable[[], Any], what: str) -> Any:
    deadline = time.monotonic() + PATIENCE_S
    while not (answer := ask()):
        assert time.monotonic() < deadline, what
        time.sleep(0.1)
    return answer


def make(http: httpx2.Client, **order: Any) -> dict[str, Any]:
    answer = http.post("/api/robots", json={"speed": 10, **order}, timeout=PATIENCE_S)
    assert answer.status_code == 201, answer.text
    robot: dict[str, Any] = answer.json()
    return robot


def test_a_wrong_order_or_command_is_refused(client: TestClient) -> None:
    for order in (
        {"home": "castle"},
        {"ring": "gold"},
        {"speed": 11},
        {"odometry": "perfect"},
        {"mode": "fly"},
    ):
        assert client.post("/api/robots", json=order).status_code == 422, order
    assert client.get("/api/robots/none").status_code == 404
    assert client.post("/api/robots/none/commands", json={"type": "stop"}).status_code == 404
    assert client.post("/api/robots/none/commands", json={"type": "jump"}).status_code == 422
    assert client.delete("/api/robots/none").status_code == 404


def test_an_app_without_an_address_says_that_it_cannot_be_fed(client: TestClient) -> None:
    answer = client.post("/api/robots", json={})
    assert answer.status_code == 409
    assert "echorooms serve" in answer.json()["detail"]
    assert "paper" in client.get("/api/robots/choices").json()["homes"]


def test_a_robot_feeds_a_session_obeys_and_leaves_a_log_and_a_model(
    start_server: StartServer,
) -> None:
    http = start_server().http
    robot = make(http, home="paper", mode="tour", seed=3)
    assert robot["simulated"] is True
    path, session = f"/api/robots/{robot['id']}", f"/api/live/{robot['session_id']}"
    wait_for(lambda: http.get(session).json()["stored"] >= 40, "scans are stored")
    assert "simulated" in http.get(session).json()["name"]

    def tell(**command: Any) -> httpx2.Response:
        return http.post(f"{path}/commands", json=command)

    assert tell(type="goal", x=-30, y=0).status_code == 422
    assert tell(type="stop").json()["task"] == "stand"
    shut = tell(type="door", name="door 4", shut=True).json()["doors"]
    assert [door["name"] for door in shut if door["shut"]] == ["door 4"]
    assert tell(type="speed", speed=2).json()["speed"] == 2
    assert tell(type="tour").json()["task"] == "tour"

    assert http.delete(path).status_code == 204
    assert http.get(path).status_code == 404
    ended = wait_for(
        lambda: (got := http.get(session).json())["status"] == "ended" and got, "it ends"
    )
    log = http.get(f"/api/logs/{ended['log_id']}").json()
    assert log["scans"] == ended["stored"]
    assert http.get(f"/api/models/{ended['model_id']}").status_code == 200


def test_a_session_that_is_finished_ends_its_robot(start_server: StartServer) -> None:
    http = start_server().http
    robot = make(http, mode="tour")
    http.delete(f"/api/live/{robot['session_id']}")
    path = f"/api/robots/{robot['id']}"
    ended = wait_for(lambda: http.get(path).json()["ended"], "the robot ends")
    assert "ended" in ended
    assert http.post(f"{path}/commands", json={"type": "tour"}).status_code == 409


def test_there_are_only_so_many_robots(start_server: StartServer) -> None:
    http = start_server().http
    for seed in range(4):
        make(http, mode="drive", seed=seed, home="hall")
    refused = http.post("/api/robots", json={"home": "hall"})
    assert refused.status_code == 409
    assert "4 robots drive already" in refused.json()["detail"]


def test_a_session_of_a_robot_that_a_crash_took_is_finished_at_the_next_start(
    start_server: StartServer,
) -> None:
    server = start_server()
    robot = make(server.http, mode="tour", home="hall")
    session = f"/api/live/{robot['session_id']}"
    wait_for(lambda: server.http.get(session).json()["stored"] > 5, "scans are stored")
    server.kill()
    http = start_server().http
    wait_for(lambda: http.get(session).json()["status"] == "ended", "it ends")


@pytest.mark.slow
def test_a_mapping_robot_goes_on_localizing_in_its_own_model(start_server: StartServer) -> None:
    http = start_server().http
    robot = make(http, mode="tour", home="paper", seed=2)
    path = f"/api/robots/{robot['id']}"
    wait_for(lambda: http.get(path).json()["distance_m"] > 12, "it drives")
    assert http.post(f"{path}/commands", json={"type": "localize"}).json()["task"] == "waiting"
    after = wait_for(
        lambda: (got := http.get(path).json())["mode"] == "localization" and got, "it localizes"
    )
    assert after["session_id"] != robot["session_id"]
    assert after["model_id"] == robot["model_id"]
    wait_for(lambda: http.get(path).json()["stored"] > 5, "scans of the new session are stored")
