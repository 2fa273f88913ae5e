"""Robots that speak MQTT, over a real broker."""

from __future__ import annotations

import asyncio
import json
import shutil
import socket
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import aiomqtt
import pytest
from fastapi.testclient import TestClient

from app.live.mqtt_link import LARGEST_MESSAGE, Broker
from app.live.mqtt_rooms import discovery, room_of, topic_name
from app.main import create_app
from app.settings import Settings
from core.errors import InputError
from core.log_readers.native import header_of
from core.log_readers.native_line import scan_record
from core.sensing import RobotLog
from core.simulation import simulate

PATIENCE_S = 60


@pytest.fixture(scope="module")
def broker(tmp_path_factory: pytest.TempPathFactory, need: Callable[[str], None]) -> Iterator[int]:
    """The port of a broker."""
    program = shutil.which("mosquitto") or shutil.which("mosquitto", path="/usr/sbin")
    if program is None:
        need("no MQTT broker: install Debian's mosquitto")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    config = tmp_path_factory.mktemp("broker") / "mosquitto.conf"
    config.write_text(f"listener {port} 127.0.0.1\nallow_anonymous true\n")
    with subprocess.Popen([str(program), "-c", str(config)], stderr=subprocess.DEVNULL) as process:
        end = time.monotonic() + 10
        while time.monotonic() < end:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    break
            time.sleep(0.05)
        yield port
        process.terminate()


@pytest.fixture
def served(broker: int, tmp_path: Path) -> Iterator[TestClient]:
    settings = Settings(
        data=tmp_path,
        warm_workers=0,
        mqtt_url=f"mqtt://127.0.0.1:{broker}",
        mqtt_topic=f"test/{tmp_path.name}",
        home_assistant=True,
    )
    with TestClient(create_app(settings), base_url="http://127.0.0.1:8000") as client:
        yield client


@pytest.fixture(scope="module")
def drive() -> RobotLog:
    return simulate("paper", seed=4).without_truth().slice(0, 40)


def talk(port: int, topic: str, messages: list[tuple[str, Any]], wanted: int) -> list[Any]:
    """Publishes messages (topic's end, content) and returns so many answers: (topic's end, content)."""

    async def run() -> list[Any]:
        found: list[Any] = []
        async with asyncio.timeout(PATIENCE_S), aiomqtt.Client("127.0.0.1", port) as client:
            for kind in ("ack", "error", "room"):
                await client.subscribe(f"{topic}/{kind}")
            for kind, content in messages:
                raw = content if isinstance(content, bytes) else json.dumps(content).encode()
                await client.publish(f"{topic}/{kind}", raw, qos=1)
            async for message in client.messages:
                if len(found) < wanted:
                    payload = json.loads(bytes(message.payload))  # type: ignore[arg-type]
                    found.append((str(message.topic).rpartition("/")[2], payload))
                if len(found) == wanted:
                    return found
        return found

    time.sleep(0.5)
    return asyncio.run(run())


def test_scans_go_the_way_of_every_other_one(
    broker: int, served: TestClient, tmp_path: Path, drive: RobotLog
) -> None:
    topic = f"test/{tmp_path.name}/ring"
    scans = [scan_record(scan) for scan in drive]
    header, first, again = talk(
        broker, topic, [("header", header_of(drive)), ("scans", scans), ("scans", scans[-1])], 3
    )
    assert header == ("ack", {"ack": None, "stored": 0})
    assert first == ("ack", {"ack": scans[-1]["t"], "stored": 40, "duplicates": 0})
    assert again[1]["duplicates"] == 1
    (session,) = served.get("/api/live").json()
    assert session["stored"] == 40
    (resumed,) = talk(broker, topic, [("header", header_of(drive))], 1)
    assert resumed == ("ack", {"ack": scans[-1]["t"], "stored": 40})
    assert len(served.get("/api/live").json()) == 1


def test_garbage_is_answered_and_survived(
    broker: int, served: TestClient, tmp_path: Path, drive: RobotLog
) -> None:
    topic = f"test/{tmp_path.name}/odd"
    scan = scan_record(next(iter(drive)))
    answers = talk(
        broker,
        topic,
        [
            ("scans", scan),
            ("header", b"\xff\xfe"),
            ("header", b'{"format": "echo'),
            ("header", [1]),
            ("header", header_of(drive) | {"mode": "flying"}),
            ("header", header_of(drive) | {"mode": "localization", "model_id": ["x"]}),
            ("header", header_of(drive) | {"mode": "localization", "model_id": "a\u0000b"}),
            ("header", header_of(drive) | {"mode": "localization", "model_id": "nothing"}),
            ("scans", b" " * (LARGEST_MESSAGE + 1)),
            ("header", header_of(drive)),
            ("scans", {"t": 1}),
            ("scans", scan),
        ],
        12,
    )
    errors = [content["error"] for kind, content in answers if kind == "error"]
    assert len(errors) == 10
    assert sum("header first" in error for error in errors) == 1
    assert answers[-1] == ("ack", {"ack": scan["t"], "stored": 1, "duplicates": 0})


def test_text_that_is_none_is_kept_as_it_came(
    broker: int, served: TestClient, tmp_path: Path, drive: RobotLog
) -> None:
    topic = f"test/{tmp_path.name}/surrogate"
    header = header_of(drive) | {"name": "\ud800", "note": "\ud800"}
    scan = scan_record(next(iter(drive))) | {"note": "\udfff"}
    _, taken = talk(broker, topic, [("header", header), ("scans", scan)], 2)
    assert taken == ("ack", {"ack": scan["t"], "stored": 1, "duplicates": 0})
    assert len(served.get("/api/live").json()) == 1


def test_robots_with_the_same_header_have_sessions_of_their_own(
    broker: int, served: TestClient, tmp_path: Path, drive: RobotLog
) -> None:
    scans = [scan_record(scan) for scan in drive]
    for name, count in (("one", 10), ("two", 5)):
        topic = f"test/{tmp_path.name}/{name}"
        messages = [("header", header_of(drive)), ("scans", scans[:count])]
        _, taken = talk(broker, topic, messages, 2)
        assert taken[1]["stored"] == count
    assert sorted(s["stored"] for s in served.get("/api/live").json()) == [5, 10]


def test_an_ended_drive_does_not_begin_again_by_its_retained_header(
    broker: int, served: TestClient, tmp_path: Path, drive: RobotLog
) -> None:
    topic = f"test/{tmp_path.name}/once"

    async def header_left() -> bytes | None:
        async with aiomqtt.Client("127.0.0.1", broker) as client:
            await client.publish(f"{topic}/header", json.dumps(header_of(drive)), 1, retain=True)
            await client.publish(f"{topic}/scans", json.dumps(scan_record(next(iter(drive)))), 1)
            await client.publish(f"{topic}/end", b"", 1)
            await asyncio.sleep(1.5)
            await client.subscribe(f"{topic}/header")
            try:
                async with asyncio.timeout(1):
                    async for message in client.messages:
                        return bytes(message.payload)  # type: ignore[arg-type]
            except TimeoutError:
                pass
            return None

    time.sleep(0.5)
    assert asyncio.run(header_left()) is None
    assert len(served.get("/api/live").json()) == 1


def test_an_address_that_is_none_is_said() -> None:
    with pytest.raises(InputError, match="mqtt://broker"):
        Broker.of("http://broker")
    assert Broker.of("mqtts://me:a%40b@box") == Broker("box", 8883, True, "me", "a@b")


def belief(probability: float, unknown: float) -> dict[str, Any]:
    return {
        "t": 1.0,
        "current_room": "n3",
        "label": "kitchen",
        "probability": probability,
        "unknown": unknown,
        "entropy": 0.2,
    }


def test_a_room_is_told_by_its_name_only_while_it_is_probable() -> None:
    assert room_of(belief(0.8, 0.1))["room"] == "kitchen"
    assert room_of(belief(0.4, 0.1))["room"] == "unknown"
    assert room_of(belief(0.8, 0.1) | {"label": None})["room"] == "n3"


def test_a_name_becomes_one_level_of_a_topic() -> None:
    assert topic_name("paper home, tour/1 #+") == "paper_home_tour_1"
    assert topic_name("/#") == "robot"


def test_home_assistant_is_told_of_a_device_with_room_and_confidence() -> None:
    sensors = discovery("Robbie 2", "Robbie_2", "echorooms/Robbie_2/room")
    assert set(sensors) == {"room", "confidence"}
    assert {s["unique_id"] for s in sensors.values()} == {
        "echorooms_Robbie_2_room",
        "echorooms_Robbie_2_confidence",
    }
    assert sensors["room"]["device"] == sensors["confidence"]["device"]
    assert sensors["confidence"]["unit_of_measurement"] == "%"
