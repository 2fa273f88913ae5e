"""A server that is killed loses nothing that it has confirmed, and leaves nothing half-written."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil

StartServer = Callable[[], Any]
MakeLog = Callable[..., bytes]


def files_below(folder: Path) -> list[str]:
    return sorted(str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file())


def test_an_upload_that_dies_half_way_leaves_nothing(
    start_server: StartServer, make_log: MakeLog
) -> None:
    server = start_server()
    server.upload(make_log(name="kept"))
    port = int(server.url.rstrip("/").rsplit(":", 1)[1])
    with socket.create_connection(("127.0.0.1", port)) as half:
        body = b'--b\r\nContent-Disposition: form-data; name="file"; filename="a.jsonl"\r\n\r\n'
        head = (
            "POST /api/logs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9000000\r\n"
            "Content-Type: multipart/form-data; boundary=b\r\n\r\n"
        )
        half.sendall(head.encode() + body + b"x" * 3_000_000)
        deadline = time.monotonic() + 10
        while not any("a.jsonl" in name for name in files_below(server.data / "temp")):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        server.kill()
    again = start_server()
    assert files_below(again.data / "temp") == []
    (log,) = again.http.get("/api/logs").json()
    assert log["name"] == "kept"
    assert len(list((again.data / "logs").iterdir())) == 1


def test_a_client_that_goes_away_in_mid_upload_leaves_nothing(start_server: StartServer) -> None:
    server = start_server()
    port = int(server.url.rstrip("/").rsplit(":", 1)[1])
    with socket.create_connection(("127.0.0.1", port)) as half:
        head = (
            "POST /api/logs HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9000000\r\n"
            "Content-Type: multipart/form-data; boundary=b\r\n\r\n--b\r\n"
        )
        half.sendall(head.encode())
        time.sleep(0.2)
    deadline = time.monotonic() + 10
    while list((server.data / "temp").iterdir()):
        assert time.monotonic() < deadline
        time.sleep(0.02)
    assert server.http.get("/api/health").status_code == 200


def test_killed_in_the_middle_of_a_job_it_keeps_the_rest_and_says_why_the_job_failed(
    start_server: StartServer, make_log: MakeLog, long_log: bytes
) -> None:
    server = start_server()
    small, large = server.upload(make_log()), server.upload(long_log)
    done = server.http.post("/api/models", json={"log_id": small["id"], "regions": 2}).json()
    _wait(server, done["job_id"])
    node = server.http.get(f"/api/models/{done['id']}").json()["nodes"][0]["id"]
    server.http.patch(f"/api/models/{done['id']}/nodes/{node}", json={"label": "kitchen"})
    before = server.http.get(f"/api/models/{done['id']}").json()
    cut = server.http.post("/api/models", json={"log_id": large["id"], "regions": 2}).json()
    deadline = time.monotonic() + 30
    while server.http.get(f"/api/jobs/{cut['job_id']}").json()["progress"] < 0.06:
        assert time.monotonic() < deadline
        time.sleep(0.05)
    workers = psutil.Process(server.process.pid).children()
    assert workers
    server.kill()
    _, alive = psutil.wait_procs(workers, timeout=20)
    assert alive == []

    again = start_server()
    assert again.http.get(f"/api/models/{done['id']}").json() == before
    job = again.http.get(f"/api/jobs/{cut['job_id']}").json()
    model = again.http.get(f"/api/models/{cut['id']}").json()
    assert job["status"] == model["status"] == "failed"
    assert "stopped" in job["error"]
    assert model["error"] == job["error"]
    assert files_below(again.data / "temp") == []
    assert [p.name for p in (again.data / "models").iterdir()] == [done["id"]]


def test_ctrl_c_ends_it_soon_even_while_somebody_follows_a_job(
    start_server: StartServer, long_log: bytes
) -> None:
    server = start_server()
    log = server.upload(long_log)
    job_id = server.http.post("/api/models", json={"log_id": log["id"], "regions": 2}).json()[
        "job_id"
    ]
    with server.http.stream("GET", f"/api/jobs/{job_id}/events") as stream:
        lines = stream.iter_lines()
        next(lines)
        took = server.stop()
        last = [line for line in lines if line][-1]
    server.http.close()
    assert took < 5
    assert '"failed"' in last
    assert server.process.returncode == 0


def test_a_data_folder_serves_one_server_at_a_time(start_server: StartServer) -> None:
    start_server()
    second = start_server()
    assert second.url == ""
    assert second.process.wait(timeout=30) != 0
    assert "in use by another EchoRooms server" in second.errors().splitlines()[-1]


def _wait(server: Any, job_id: str) -> None:
    deadline = time.monotonic() + 60
    while server.http.get(f"/api/jobs/{job_id}").json()["status"] in ("queued", "running"):
        assert time.monotonic() < deadline
        time.sleep(0.05)
