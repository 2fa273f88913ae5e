"""A server in this process, and small drives to send to it."""

from __future__ import annotations

import gzip
import json
import math
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest
from fastapi.testclient import TestClient

from app.main import create_app
from app.settings import Settings

SERVER = """
import json
import sys
from pathlib import Path
from app.serve import run
from app.settings import Settings
given = json.loads(sys.argv[2])
settings = Settings(data=Path(sys.argv[1]), **{"port": 0, "warm_workers": 1, **given})
run(settings, lambda url: print(url, flush=True))
"""


LOOPBACK = "http://127.0.0.1:8000"
ROOM_HALF_M = 2.0
SONARS = 8
LONG_SCANS = 12_000


def native_log(scans: int = 80, name: str = "square room", start_t: float = 0.0) -> bytes:
    """A drive along a circle of 1 m in a room of 4 m x 4 m, in the native format."""
    sonars = [
        {
            "x": 0.0,
            "y": 0.0,
            "heading": math.remainder(2 * math.pi * i / SONARS, 2 * math.pi),
            "beam_width": 0.5,
            "min_range": 0.1,
            "max_range": 4.0,
        }
        for i in range(SONARS)
    ]
    header = {
        "format": "echorooms-log",
        "version": 1,
        "name": name,
        "robot": {"radius": 0.2},
        "sonars": sonars,
    }
    lines = [json.dumps(header)]
    for i in range(scans):
        angle = 2 * math.pi * i / scans
        x, y, heading = math.cos(angle), math.sin(angle), angle + math.pi / 2
        ranges = [round(_to_wall(x, y, heading + sonar["heading"]), 3) for sonar in sonars]
        scan = {"t": start_t + 0.25 * i, "odom": [x, y, heading], "ranges": ranges}
        lines.append(json.dumps(scan))
    return ("\n".join(lines) + "\n").encode()


def _to_wall(x: float, y: float, heading: float) -> float:
    cos, sin = math.cos(heading), math.sin(heading)
    along_x = (math.copysign(ROOM_HALF_M, cos) - x) / cos if abs(cos) > 1e-9 else math.inf
    along_y = (math.copysign(ROOM_HALF_M, sin) - y) / sin if abs(sin) > 1e-9 else math.inf
    return min(along_x, along_y)


@pytest.fixture(scope="session")
def make_log() -> Callable[..., bytes]:
    """Makes the bytes of a small native log."""
    return native_log


@pytest.fixture(scope="session")
def long_log() -> bytes:
    """A drive that takes seconds to map."""
    return native_log(scans=LONG_SCANS, name="long drive")


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    """Settings of a server with an empty data folder."""
    return Settings(data=tmp_path / "data", max_jobs=2, warm_workers=1, heartbeat_s=0.5)


@pytest.fixture
def client(settings: Settings) -> Iterator[TestClient]:
    """A server of its own."""
    with TestClient(create_app(settings), base_url=LOOPBACK) as client:
        yield client


@pytest.fixture(scope="session")
def shared_settings(tmp_path_factory: pytest.TempPathFactory) -> Settings:
    """Settings of the shared server."""
    folder = tmp_path_factory.mktemp("shared")
    return Settings(data=folder / "data", max_jobs=2, warm_workers=1)


@pytest.fixture(scope="session")
def shared_client(shared_settings: Settings) -> Iterator[TestClient]:
    """A server that tests share which look at their own things only."""
    with TestClient(create_app(shared_settings), base_url=LOOPBACK) as client:
        yield client


@pytest.fixture(scope="session")
def upload() -> Callable[..., dict[str, Any]]:
    """Uploads a log and returns what the server says of it."""

    def send(client: TestClient, content: bytes | None = None, **fields: str) -> dict[str, Any]:
        files = {"file": ("drive.jsonl.gz", gzip.compress(content or native_log()))}
        response = client.post("/api/logs", files=files, data=fields)
        assert response.status_code == 201, response.text
        answer: dict[str, Any] = response.json()
        return answer

    return send


@pytest.fixture(scope="session")
def wait_for_job() -> Callable[..., dict[str, Any]]:
    """Waits until a job has ended and returns it."""

    def wait(client: TestClient, job_id: str, seconds: float = 600) -> dict[str, Any]:
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            job: dict[str, Any] = client.get(f"/api/jobs/{job_id}").json()
            if job["status"] not in ("queued", "running"):
                return job
            time.sleep(0.05)
        pytest.fail(f"job {job_id} did not end in {seconds} s: {job}")

    return wait


@pytest.fixture(scope="session")
def make_model(
    upload: Callable[..., dict[str, Any]], wait_for_job: Callable[..., dict[str, Any]]
) -> Callable[..., str]:
    """Models a small log offline and returns the model's id."""

    def make(client: TestClient, log_id: str | None = None, regions: int = 3) -> str:
        body = {"log_id": log_id or upload(client)["id"], "mode": "offline", "regions": regions}
        accepted = client.post("/api/models", json=body)
        assert accepted.status_code == 202, accepted.text
        job = wait_for_job(client, accepted.json()["job_id"])
        assert job["status"] == "done", job
        return str(accepted.json()["id"])

    return make


@pytest.fixture(scope="session")
def shared_model(shared_client: TestClient, make_model: Callable[..., str]) -> str:
    """A finished model of three regions on the shared server; tests leave it without labels."""
    return make_model(shared_client)


class Server:
    """A server in a process of its own."""

    def __init__(self, data: Path, **settings: Any) -> None:
        self.data = data
        self.stderr = data.with_suffix(".stderr")
        self.process = subprocess.Popen(
            [sys.executable, "-c", SERVER, str(data), json.dumps(settings)],
            stdout=subprocess.PIPE,
            stderr=self.stderr.open("a"),
            text=True,
        )
        assert self.process.stdout is not None
        self.url = self.process.stdout.readline().strip()
        self.http = httpx2.Client(base_url=self.url, timeout=30)

    def upload(self, content: bytes) -> dict[str, Any]:
        answer = self.http.post("/api/logs", files={"file": ("drive.jsonl", content)})
        assert answer.status_code == 201, answer.text
        log: dict[str, Any] = answer.json()
        return log

    def errors(self) -> str:
        """What it has written on standard error."""
        return self.stderr.read_text()

    def kill(self) -> None:
        """Ends it as a power cut would."""
        self.process.kill()
        self.process.wait()
        self.http.close()

    def stop(self) -> float:
        """Ends it as Ctrl-C would; returns how long that took in seconds."""
        started = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        self.process.wait(timeout=20)
        return time.monotonic() - started


@pytest.fixture
def start_server(tmp_path: Path) -> Iterator[Callable[..., Server]]:
    """Starts servers, one after another, on one data folder."""
    servers: list[Server] = []

    def begin(**settings: Any) -> Server:
        servers.append(Server(tmp_path / "data", **settings))
        return servers[-1]

    yield begin
    for server in servers:
        if server.process.poll() is None:
            server.kill()
