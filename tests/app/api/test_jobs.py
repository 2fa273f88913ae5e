"""Jobs over HTTP."""

from __future__ import annotations

import json
import os
import signal
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import psutil
import pytest
from fastapi.testclient import TestClient

from app.main import create_app
from app.settings import Settings

Upload = Callable[..., dict[str, Any]]
Wait = Callable[..., dict[str, Any]]
Workers = Callable[[], list[psutil.Process]]


def start(client: TestClient, log_id: str, regions: int = 2) -> tuple[str, str]:
    """Starts to model a log; returns the ids of model and job."""
    body = {"log_id": log_id, "regions": regions}
    accepted = client.post("/api/models", json=body).json()
    return accepted["id"], accepted["job_id"]


def wait_until_running(client: TestClient, job_id: str) -> None:
    deadline = time.monotonic() + 30
    while client.get(f"/api/jobs/{job_id}").json()["what"] in (
        "",
        "waiting for other jobs",
        "starting",
    ):
        assert time.monotonic() < deadline
        time.sleep(0.02)


@pytest.fixture
def workers() -> Callable[[], list[psutil.Process]]:
    """Tells the worker processes that were started since the test began."""

    def children() -> list[psutil.Process]:
        return psutil.Process().children(recursive=True)

    before = children()
    return lambda: [process for process in children() if process not in before]


def events(client: TestClient, job_id: str) -> tuple[list[dict[str, Any]], list[str]]:
    """Everything that the stream of a job says until it ends: jobs, and comments."""
    jobs, comments = [], []
    with client.stream("GET", f"/api/jobs/{job_id}/events") as stream:
        assert stream.headers["content-type"].startswith("text/event-stream")
        for line in stream.iter_lines():
            if line.startswith("data: "):
                jobs.append(json.loads(line.removeprefix("data: ")))
            elif line:
                comments.append(line)
    return jobs, comments


def test_the_stream_of_a_job_tells_its_progress_and_ends_with_it(
    client: TestClient, upload: Upload
) -> None:
    _, job_id = start(client, upload(client)["id"])
    told, _ = events(client, job_id)
    shares = [job["progress"] for job in told]
    assert shares == sorted(shares)
    assert {job["id"] for job in told} == {job_id}
    assert told[-1]["status"] == "done"
    assert told[-1]["progress"] == 1.0
    assert all(job["status"] != "done" for job in told[:-1])
    assert told[-1] == client.get(f"/api/jobs/{job_id}").json() | {"what": told[-1]["what"]}
    assert events(client, job_id)[0][0]["status"] == "done"


def test_a_waiting_job_is_queued_and_its_stream_says_that_it_lives(
    tmp_path: Path, upload: Upload, long_log: bytes
) -> None:
    settings = Settings(data=tmp_path / "data", max_jobs=1, warm_workers=1, heartbeat_s=0.05)
    with TestClient(create_app(settings), base_url="http://127.0.0.1") as client:
        log_id = upload(client, long_log)["id"]
        _, running = start(client, log_id)
        waiting_model, waiting = start(client, log_id)
        wait_until_running(client, running)
        assert client.get(f"/api/jobs/{waiting}").json()["status"] == "queued"
        assert client.get(f"/api/models/{waiting_model}").json()["status"] == "queued"
        health = client.get("/api/health").json()
        assert (health["jobs_running"], health["jobs_waiting"]) == (1, 1)
        with ThreadPoolExecutor() as pool:
            following = pool.submit(events, client, waiting)
            time.sleep(0.5)
            assert client.delete(f"/api/jobs/{waiting}").json()["status"] == "cancelled"
            told, comments = following.result(timeout=10)
        assert [job["status"] for job in told] == ["queued", "cancelled"]
        assert comments
        assert all(comment.startswith(":") for comment in comments)
        assert client.delete(f"/api/jobs/{running}").json()["status"] == "cancelled"
        assert client.get(f"/api/models/{waiting_model}").json()["status"] == "cancelled"


def test_cancelling_kills_the_worker_at_once_and_leaves_nothing(
    workers: Workers, client: TestClient, upload: Upload, long_log: bytes, settings: Settings
) -> None:
    log_id = upload(client, long_log)["id"]
    model_id, job_id = start(client, log_id)
    wait_until_running(client, job_id)
    before = {process.pid for process in workers()}
    started = time.monotonic()
    job = client.delete(f"/api/jobs/{job_id}").json()
    assert time.monotonic() - started < 2
    assert job["status"] == "cancelled"
    assert job["error"] is None
    assert len(before & {process.pid for process in workers()}) < len(before)
    assert client.get(f"/api/models/{model_id}").json()["status"] == "cancelled"
    assert list((settings.data / "temp").iterdir()) == []
    assert list((settings.data / "models").iterdir()) == []
    assert client.delete(f"/api/jobs/{job_id}").json() == client.get(f"/api/jobs/{job_id}").json()


def test_a_killed_worker_fails_its_job_with_the_reason_and_the_next_job_works(
    workers: Workers, client: TestClient, upload: Upload, long_log: bytes, wait_for_job: Wait
) -> None:
    log_id = upload(client, long_log)["id"]
    model_id, job_id = start(client, log_id)
    wait_until_running(client, job_id)
    for process in workers():
        os.kill(process.pid, signal.SIGKILL)
    job = wait_for_job(client, job_id)
    assert job["status"] == "failed"
    assert "SIGKILL" in job["error"]
    assert "memory" in job["error"]
    assert client.get(f"/api/models/{model_id}").json()["error"] == job["error"]
    _, next_job = start(client, upload(client)["id"])
    assert wait_for_job(client, next_job)["status"] == "done"


def test_deleting_a_model_stops_its_job(
    client: TestClient, upload: Upload, long_log: bytes
) -> None:
    model_id, job_id = start(client, upload(client, long_log)["id"])
    wait_until_running(client, job_id)
    assert client.delete(f"/api/models/{model_id}").status_code == 204
    assert client.get(f"/api/jobs/{job_id}").json()["status"] == "cancelled"
    assert client.get(f"/api/models/{model_id}").status_code == 404


def test_a_job_that_takes_too_long_fails_with_the_reason(
    tmp_path: Path, upload: Upload, long_log: bytes, wait_for_job: Wait
) -> None:
    settings = Settings(data=tmp_path / "data", warm_workers=1, job_timeout_s=0.3)
    with TestClient(create_app(settings), base_url="http://127.0.0.1") as client:
        _, job_id = start(client, upload(client, long_log)["id"])
        job = wait_for_job(client, job_id)
        assert job["status"] == "failed"
        assert "0.3 s" in job["error"]
        assert list((settings.data / "temp").iterdir()) == []


def test_an_upload_that_takes_too_long_to_read_is_refused(tmp_path: Path, long_log: bytes) -> None:
    settings = Settings(data=tmp_path / "data", warm_workers=1, upload_timeout_s=0.1)
    with TestClient(create_app(settings), base_url="http://127.0.0.1") as client:
        response = client.post("/api/logs", files={"file": ("a.jsonl", long_log)})
        assert response.status_code == 422
        assert "0.1 s" in response.json()["detail"]
        assert client.get("/api/logs").json() == []
        assert list((settings.data / "temp").iterdir()) == []


def test_stopping_the_server_fails_what_runs_and_the_next_start_says_why(
    workers: Workers, settings: Settings, upload: Upload, long_log: bytes
) -> None:
    with TestClient(create_app(settings), base_url="http://127.0.0.1") as client:
        model_id, job_id = start(client, upload(client, long_log)["id"])
        wait_until_running(client, job_id)
    assert workers() == []
    with TestClient(create_app(settings), base_url="http://127.0.0.1") as client:
        job = client.get(f"/api/jobs/{job_id}").json()
        assert job["status"] == "failed"
        assert "stopped" in job["error"]
        assert client.get(f"/api/models/{model_id}").json()["error"] == job["error"]
