"""The map as it grows along a drive: what autonomous modelling looks at."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from core.geometry import FloatArray
from core.mapping.cemal import CemalConfig
from core.mapping.incremental_cemal import IncrementalCemal
from core.mapping.map_result import MapResult
from core.pipeline.mapper import MappingOptions, map_scans
from core.sensing import RobotLog, Scan, SonarRing, Trajectory


class GrowingMap(Protocol):
    """A map that takes in scans, with what the robot has seen lately and with everything."""

    def add(self, scan: Scan, pose: FloatArray) -> None:
        """Takes in a scan that was made at a pose (3,) of the map's frame."""

    def local(self) -> MapResult:
        """The local map around the robot."""

    def whole(self) -> MapResult:
        """The map of everything so far."""


def growing_map(ring: SonarRing, options: MappingOptions, window: float | None) -> GrowingMap:
    """An empty map.

    Args:
        ring: of the robot.
        options: mapping method and resolution.
        window: metres of travel that the local map holds; None takes everything so far.
    """
    if window is None and options.method == "cemal":
        return IncrementalMap(ring, CemalConfig(resolution=options.resolution))
    return RemadeMap(ring, options, window)


class IncrementalMap:
    """CEMAL scan by scan; what a scan costs does not grow with the drive."""

    def __init__(self, ring: SonarRing, config: CemalConfig) -> None:
        self._cemal = IncrementalCemal(ring, config)

    def add(self, scan: Scan, pose: FloatArray) -> None:
        """Takes in a scan."""
        self._cemal.add(scan, pose)

    def local(self) -> MapResult:
        """The map of everything: nothing is gained by leaving something out."""
        return self._cemal.result()

    def whole(self) -> MapResult:
        """The map of everything."""
        return self._cemal.result()


class RemadeMap:
    """A map made anew from the scans each time, for the paper's local map and the log-odds baseline.

    With a window the local map costs the same all along the drive; log-odds of everything do not.
    """

    def __init__(self, ring: SonarRing, options: MappingOptions, window: float | None) -> None:
        self._ring, self._options, self._window = ring, options, window
        self._scans: list[Scan] = []
        self._poses: list[FloatArray] = []

    def add(self, scan: Scan, pose: FloatArray) -> None:
        """Takes in a scan."""
        self._scans.append(scan)
        self._poses.append(pose)

    def local(self) -> MapResult:
        """The map of the last metres of travel."""
        if self._window is None:
            return self.whole()
        first, left = len(self._poses) - 1, self._window
        while first > 0:
            left -= float(np.hypot(*(self._poses[first][:2] - self._poses[first - 1][:2])))
            if left < 0:
                break
            first -= 1
        return self._map(first)

    def whole(self) -> MapResult:
        """The map of all scans."""
        return self._map(0)

    def _map(self, first: int) -> MapResult:
        scans = self._scans[first:]
        t = np.array([scan.t for scan in scans])
        poses = np.array(self._poses[first:])
        ranges = np.array([scan.ranges for scan in scans])
        fresh = np.array([scan.fresh for scan in scans])
        log = RobotLog("drive so far", self._ring, t, poses, ranges, fresh)
        return map_scans(log, Trajectory.at(t, poses), self._options)
