"""What a ROS robot publishes becomes scans."""

from __future__ import annotations

import json
import math
import threading
from collections.abc import Iterator
from typing import Any

import pytest
from websockets.sync.server import ServerConnection, serve

from app.live.ros_scans import CLOUD_TYPE, ODOMETRY_TYPE, RANGE_TYPE, RosScans, RosTopics
from app.live.rosbridge import messages
from core.errors import InputError, LogError
from core.sensing import Sonar, SonarRing

RING = SonarRing(
    robot_radius=0.2,
    sonars=(Sonar(0.1, 0.0, 0.0, 0.5, 0.03, 4.0), Sonar(0.0, 0.1, math.pi / 2, 0.5, 0.03, 4.0)),
)
TOPICS = RosTopics("/odom", ("/front", "/left"))


def odometry(t: float, x: float = 0.0, yaw: float = 0.0) -> dict[str, Any]:
    orientation = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    stamp = {"secs": int(t), "nsecs": round((t % 1) * 1e9)}
    pose = {"position": {"x": x, "y": 1.0, "z": 0.0}, "orientation": orientation}
    return {"header": {"stamp": stamp}, "pose": {"pose": pose}}


def test_ranges_and_odometry_make_a_scan() -> None:
    scans = RosScans(RING, TOPICS)
    scans.take("/front", {"range": 1.5})
    scans.take("/left", {"range": math.inf})
    record = scans.take("/odom", odometry(12.25, 2.0, math.pi / 2))
    assert record is not None
    assert record["ranges"] == [1.5, None]
    assert record["odom"] == pytest.approx([2.0, 1.0, math.pi / 2])
    assert record["t"] == 12.25
    assert "stale" not in record


def test_a_sonar_that_was_not_heard_since_is_stale() -> None:
    scans = RosScans(RING, TOPICS)
    scans.take("/front", {"range": 1.5})
    scans.take("/left", {"range": 0.5})
    scans.take("/odom", odometry(1.0))
    scans.take("/front", {"range": 1.4})
    assert scans.take("/odom", odometry(1.1)) is None
    record = scans.take("/odom", odometry(1.25))
    assert record is not None
    assert (record["ranges"], record["stale"]) == ([1.4, 0.5], [1])


def test_points_of_a_cloud_are_distances_from_their_sonars() -> None:
    scans = RosScans(RING, RosTopics("/odom", cloud="/sonar"))
    scans.take("/sonar", {"points": [{"x": 1.1, "y": 0.0}, {"x": 0.0, "y": 2.1}]})
    record = scans.take("/odom", odometry(0.5))
    assert record is not None
    assert record["ranges"] == [1.0, 2.0]


def test_the_time_of_ros_2_is_understood() -> None:
    scans = RosScans(RING, TOPICS)
    scans.take("/front", {"range": 1.0})
    message = odometry(0.0) | {"header": {"stamp": {"sec": 3, "nanosec": 500_000_000}}}
    record = scans.take("/odom", message)
    assert record is not None
    assert record["t"] == 3.5


@pytest.mark.parametrize(
    ("topic", "message"),
    [
        ("/front", None),
        ("/front", {"range": "far"}),
        ("/odom", {}),
        ("/odom", odometry(1.0, math.nan)),
        ("/sonar", {"points": []}),
    ],
)
def test_what_is_no_message_of_its_type_is_said(topic: str, message: Any) -> None:
    scans = RosScans(RING, RosTopics("/odom", ("/front", "/left"), "/sonar"))
    with pytest.raises(LogError, match=topic):
        scans.take(topic, message)


@pytest.fixture
def peer() -> Iterator[tuple[str, list[dict[str, Any]]]]:
    """A rosbridge that publishes, garbage too, and hangs up once; what it was asked."""
    asked: list[dict[str, Any]] = []

    def talk(socket: ServerConnection) -> None:
        asked.extend(json.loads(socket.recv()) for _ in range(3))
        for frame in ("nonsense", '{"op": "publish"', "[1]", '{"op": "status", "level": "error"}'):
            socket.send(frame)
        message = {"op": "publish", "topic": "/front", "msg": {"range": float(len(asked))}}
        socket.send(json.dumps(message))

    with serve(talk, "127.0.0.1", 0) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        yield f"ws://127.0.0.1:{server.socket.getsockname()[1]}", asked
        server.shutdown()


def test_topics_are_subscribed_garbage_survived_and_lost_connections_made_again(
    peer: tuple[str, list[dict[str, Any]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    url, asked = peer
    monkeypatch.setattr("app.live.rosbridge.RETRY_S", 0.05)
    heard = messages(url, TOPICS.types())
    assert next(heard) == ("/front", {"range": 3.0})
    assert next(heard) == ("/front", {"range": 6.0})
    assert {a["topic"]: a["type"] for a in asked[:3]} == {
        "/odom": ODOMETRY_TYPE,
        "/front": RANGE_TYPE,
        "/left": RANGE_TYPE,
    }
    assert RosTopics("/odom", cloud="/c").types()["/c"] == CLOUD_TYPE
    heard.close()


def test_no_rosbridge_is_said() -> None:
    with pytest.raises(InputError, match="no rosbridge"):
        next(messages("ws://127.0.0.1:9", TOPICS.types()))
