"""ROS messages of sonars and wheels, as rosbridge sends them in JSON, put together to scans.

`sensor_msgs/Range` is one sonar's distance, `sensor_msgs/PointCloud` a ring's echoes in the robot's
frame, `nav_msgs/Odometry` the pose. A scan is made for an odometry message when enough time has
passed since the last one; sonars that were not heard since then are marked as stale.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from core.errors import LogError
from core.sensing import SonarRing
from core.wording import counted

RANGE_TYPE, CLOUD_TYPE = "sensor_msgs/Range", "sensor_msgs/PointCloud"
ODOMETRY_TYPE = "nav_msgs/Odometry"
PERIOD_S = 0.25
"""Between two scans: four a second are plenty for a map."""


@dataclass(frozen=True)
class RosTopics:
    """Which topics are heard: one `ranges` topic a sonar in the order of the ring, or a `cloud`."""

    odometry: str
    ranges: Sequence[str] = ()
    cloud: str | None = None

    def types(self) -> dict[str, str]:
        """The message type of every topic."""
        found = {self.odometry: ODOMETRY_TYPE} | dict.fromkeys(self.ranges, RANGE_TYPE)
        return found | ({self.cloud: CLOUD_TYPE} if self.cloud else {})


class RosScans:
    """Takes messages in the order in which they come."""

    def __init__(self, ring: SonarRing, topics: RosTopics) -> None:
        self._ring = ring
        self._topics = topics
        self._ranges: list[float | None] = [None] * len(ring)
        self._fresh: set[int] = set()
        self._t: float | None = None

    def take(self, topic: str, message: Any) -> dict[str, Any] | None:
        """The scan that a message completes, if it does.

        Raises:
            LogError: it is no message of the topic's type.
        """
        try:
            if topic == self._topics.odometry:
                return self._scan(message)
            if topic == self._topics.cloud:
                self._take_cloud(message["points"])
            elif topic in self._topics.ranges:
                self._take_range(self._topics.ranges.index(topic), float(message["range"]))
        except (KeyError, TypeError, ValueError, IndexError) as error:
            raise LogError(f"a message of {topic} is not of its type ({error!r})") from error
        return None

    def _take_range(self, sonar: int, distance: float) -> None:
        limit = self._ring.sonars[sonar].max_range
        heard = math.isfinite(distance) and 0 < distance < limit
        self._ranges[sonar] = round(distance, 3) if heard else None
        self._fresh.add(sonar)

    def _take_cloud(self, points: Sequence[Any]) -> None:
        """Point i is the echo of sonar i, in the robot's frame."""
        if len(points) != len(self._ring):
            raise ValueError(
                f"{counted(len(points), 'point')} for a ring of {counted(len(self._ring), 'sonar')}"
            )
        for i, (sonar, point) in enumerate(zip(self._ring.sonars, points, strict=True)):
            away = math.hypot(float(point["x"]) - sonar.x, float(point["y"]) - sonar.y)
            self._take_range(i, away)

    def _scan(self, message: Any) -> dict[str, Any] | None:
        t, pose = _seconds(message["header"]["stamp"]), message["pose"]["pose"]
        odometry = [float(pose["position"]["x"]), float(pose["position"]["y"]), _yaw(pose)]
        if not np.isfinite([t, *odometry]).all():
            raise ValueError("not finite")
        due = self._t is None or t >= self._t + PERIOD_S
        if not due or not self._fresh:
            return None
        stale = [i for i in range(len(self._ring)) if i not in self._fresh]
        record: dict[str, Any] = {"t": round(t, 4), "odom": odometry, "ranges": list(self._ranges)}
        if stale:
            record["stale"] = stale
        self._t = t
        self._fresh.clear()
        return record


def _seconds(stamp: Any) -> float:
    """A time of ROS 1 (`secs`, `nsecs`) or ROS 2 (`sec`, `nanosec`)."""
    if "sec" in stamp:
        return float(stamp["sec"]) + float(stamp["nanosec"]) * 1e-9
    return float(stamp["secs"]) + float(stamp["nsecs"]) * 1e-9


def _yaw(pose: Any) -> float:
    """Heading of a quaternion, radians."""
    x, y, z, w = (float(pose["orientation"][axis]) for axis in "xyzw")
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
