"""What a live session has told so far, so that a tab can draw now or any moment before."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from typing import Any

import numpy as np

from app.viewer.messages import Belief
from core.geometry import FloatArray, between, compose
from core.sensing.ring import SonarRing

PATH_STEP = 0.05
"""Metres between two points of the drawn trajectory."""
LONGEST_STEP = 0.6
"""A robot does not drive further between two points (m): it was carried, or found elsewhere."""
LEAST_CORRECTION = 0.01
"""Metres or radians by which a frame has to move before anything is drawn elsewhere."""
LOST = 0.5
"""A robot is drawn nowhere when it is at least so probable that it is nowhere in the map."""


class LiveTrack:
    """The scans and beliefs of a session, in the map's frame. Event loop's thread only.

    A mapping robot is drawn where its corrected odometry says; one that is looked for in a model,
    where the latest belief put it, moved on by its odometry. Before the first belief, and while it is
    probably nowhere in the map, it is drawn nowhere.

    Attributes:
        times: of the scans.
        found: how often a belief or drift correction has moved what was driven since.
    """

    def __init__(self, ring: SonarRing, localizes: bool) -> None:
        self.ring = ring
        self.localizes = localizes
        self.times: list[float] = []
        self.found = 0
        self._odometry: list[FloatArray] = []
        self._ranges: list[FloatArray] = []
        self._poses: list[FloatArray | None] = []
        self._path: list[tuple[int, float, float]] = []
        self._frame = np.zeros(3)
        self._belief_times: list[float] = []
        self._beliefs: list[dict[str, Any]] = []

    def __len__(self) -> int:
        return len(self.times)

    def add(self, t: float, odometry: list[float], ranges: list[float | None]) -> None:
        """A scan; one that is not newer than the last is left out."""
        if self.times and t <= self.times[-1]:
            return
        self.times.append(t)
        self._odometry.append(np.array(odometry, float))
        self._ranges.append(np.array([np.nan if r is None else r for r in ranges], float))
        self._poses.append(self._located(len(self.times) - 1))
        self._lengthen_path(len(self.times) - 1)

    def believe(self, event: dict[str, Any]) -> None:
        """A belief event of the session: where the robot is at its time, and ever since."""
        self._belief_times.append(float(event["t"]))
        self._beliefs.append(event)
        if not self.localizes:
            return
        self.found += 1
        self._locate_from(event["t"])

    def correct(self, t: float, frame: list[float]) -> None:
        """Drift correction tells the pose (3,) of the odometry's frame in the map's since a time."""
        moved = np.abs(np.array(frame, float) - self._frame).max()
        if moved < LEAST_CORRECTION or self.localizes:
            return
        self._frame = np.array(frame, float)
        self.found += 1
        self._locate_from(t)

    def index_at(self, t: float | None) -> int:
        """The last scan that is not later than `t` (None: the last of all); 0 before the first."""
        if t is None:
            return len(self.times) - 1
        return max(0, bisect_right(self.times, t) - 1)

    def pose(self, index: int) -> FloatArray | None:
        """(3,) where the robot was at a scan; None while nobody knows."""
        return self._poses[index]

    def ranges(self, index: int) -> FloatArray:
        """(S,) readings of a scan, metres, NaN = no echo."""
        return self._ranges[index]

    def path(self, index: int) -> FloatArray:
        """(K, 2, 2) segments of the way until a scan; the last one ends at the robot."""
        pose = self.pose(index)
        count = bisect_left(self._path, (index + 1,))
        points = [point[1:] for point in self._path[:count]]
        if pose is not None:
            points.append((float(pose[0]), float(pose[1])))
        flat = np.array(points, float).reshape(-1, 2)
        segments = np.stack((flat[:-1], flat[1:]), axis=1)
        return np.asarray(segments[np.hypot(*(segments[:, 1] - segments[:, 0]).T) < LONGEST_STEP])

    def belief(self, index: int) -> Belief | None:
        """What was believed at a scan, the robot moved on to it."""
        event = self._event_at(self.times[index])
        if event is None:
            return None
        pose = self.pose(index)
        x, y, heading = event["pose"] if pose is None else pose.tolist()
        return Belief(
            probabilities=event["probabilities"],
            unknown=event["unknown"],
            pose=(x, y, heading),
            template=(),
        )

    def _locate_from(self, t: float) -> None:
        """Finds out anew where the robot was at a time and ever since."""
        first = self.index_at(t)
        self._path = [point for point in self._path if point[0] < first]
        for index in range(first, len(self.times)):
            self._poses[index] = self._located(index)
            self._lengthen_path(index)

    def _located(self, index: int) -> FloatArray | None:
        if not self.localizes:
            return compose(self._frame, self._odometry[index])
        event = self._event_at(self.times[index])
        if event is None or event["unknown"] >= LOST:
            return None
        moved = between(self._odometry[self.index_at(event["t"])], self._odometry[index])
        return compose(np.array(event["pose"], float), moved)

    def _event_at(self, t: float) -> dict[str, Any] | None:
        count = bisect_right(self._belief_times, t)
        return self._beliefs[count - 1] if count else None

    def _lengthen_path(self, index: int) -> None:
        pose = self._poses[index]
        if pose is None:
            return
        x, y = float(pose[0]), float(pose[1])
        if not self._path or np.hypot(x - self._path[-1][1], y - self._path[-1][2]) >= PATH_STEP:
            self._path.append((index, x, y))
