"""Modelling while the robot drives (paper, 3.2, Fig. 2): state + scan -> state.

A model of a log is a fold over its scans; a live session adds them as they come. Steps are taken at
multiples of a distance from the start of the drive, and depend on nothing but the scans before, so
it is the same whether a drive comes in one log, in two or scan by scan. The object can be pickled
between two scans and goes on from there. When the poses of earlier scans have moved (drift
correction), fold the whole drive again from a new one: `grown_along`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

import numpy as np

from core.geometry import FloatArray, wrap_angle
from core.mapping.map_result import MapResult
from core.pipeline.growing_map import growing_map
from core.pipeline.mapper import MappingOptions
from core.progress import Progress, no_progress
from core.segmentation.autonomous import AutonomousConfig, extract, finish
from core.segmentation.extraction_state import ExtractionState
from core.segmentation.moment import Moment
from core.segmentation.paper_config import PaperConfig
from core.segmentation.paper_end import finish_as_in_paper
from core.segmentation.paper_extraction import extract_as_in_paper
from core.sensing import RobotLog, Scan, SonarRing, Trajectory

MethodName = Literal["default", "paper"]
Config = TypeVar("Config", AutonomousConfig, PaperConfig)
KEY_DISTANCE, KEY_TURN = 0.12, 0.25
"""Metres and radians between key scans. At 0.15 m/s and 4 Hz every third or fourth scan is one; a
map of every fourth scan measured as good as one of all."""


@dataclass(frozen=True)
class ExtractionMethod(Generic[Config]):
    """How regions are extracted: parameters, one step, and the end of a drive."""

    config: Config
    extract: Callable[[ExtractionState, Moment, Config], ExtractionState]
    finish: Callable[[ExtractionState, Moment, Config], ExtractionState]


METHODS: dict[MethodName, ExtractionMethod[Any]] = {
    "default": ExtractionMethod(AutonomousConfig(), extract, finish),
    "paper": ExtractionMethod(PaperConfig(), extract_as_in_paper, finish_as_in_paper),
}


class GrowingModel:
    """The state of autonomous modelling.

    Attributes:
        method: how regions are extracted.
        state: the regions extracted so far, with their history.
        driven: metres so far.
    """

    def __init__(
        self,
        ring: SonarRing,
        mapping: MappingOptions | None = None,
        method: ExtractionMethod[Any] | None = None,
    ) -> None:
        self.method = method or METHODS["default"]
        self.state = ExtractionState()
        self.driven = 0.0
        self._map = growing_map(ring, mapping or MappingOptions(), self.method.config.window)
        self._t: list[float] = []
        self._poses: list[FloatArray] = []
        self._key: FloatArray | None = None

    def add(self, scan: Scan, pose: FloatArray) -> bool:
        """Takes in a scan that was made at a pose (3,); returns whether a step was taken."""
        step = self.method.config.step
        before = np.floor(self.driven / step)
        if self._poses:
            self.driven += float(np.hypot(*(pose[:2] - self._poses[-1][:2])))
        self._t.append(scan.t)
        self._poses.append(pose)
        if self._key is None or apart(pose, self._key):
            self._map.add(scan, pose)
            self._key = pose
        if np.floor(self.driven / step) <= before:
            return False
        moment = self.moment(self._map.local())
        self.state = self.method.extract(self.state, moment, self.method.config)
        return True

    @property
    def pose(self) -> FloatArray:
        """(3,) of the last scan."""
        return self._poses[-1]

    @property
    def trajectory(self) -> Trajectory:
        """The poses so far, taken as exact."""
        return Trajectory.at(np.array(self._t), np.array(self._poses))

    def whole_map(self) -> MapResult:
        """The map of everything so far."""
        return self._map.whole()

    def finished(self, moment: Moment) -> ExtractionState:
        """What the regions are if the drive ends at a moment; the drive itself can go on."""
        return self.method.finish(self.state, moment, self.method.config)

    def moment(self, result: MapResult) -> Moment:
        """Now, as it is seen on a map: where the robot is and what it knows."""
        return Moment(self._t[-1], self.driven, self._poses[-1], result.grid, result.confidence)


def grown_along(
    log: RobotLog,
    trajectory: Trajectory,
    mapping: MappingOptions,
    method: ExtractionMethod[Any],
    progress: Progress = no_progress,
) -> GrowingModel:
    """The fold over a whole drive at the poses of a trajectory, one for each scan."""
    model = GrowingModel(log.ring, mapping, method)
    for i, scan in enumerate(log):
        if model.add(scan, trajectory.poses[i]):
            progress((i + 1) / len(log), "extracting regions along the drive")
    return model


def apart(pose: FloatArray, other: FloatArray) -> bool:
    """Whether a scan at a pose (3,) tells something new after one at the other."""
    away = float(np.hypot(*(pose[:2] - other[:2])))
    return away >= KEY_DISTANCE or abs(float(wrap_angle(pose[2] - other[2]))) >= KEY_TURN
