"""A drive that has not ended: corrected poses, map and regions, scan by scan.

The poses are those of `GrowingTrajectory`; the regions those of `GrowingModel`. When drift correction
moves what was mapped before, the drive is folded again at the better poses - at most once for every
`RENEWED_SHARE` of its length, so that the cost of a scan stays bounded as the drive grows. Can be
pickled between two scans. When the drive has ended, `model_log` models it once more as a whole.
"""

from __future__ import annotations

from core.errors import InputError
from core.geometry import FloatArray
from core.mapping.growing_trajectory import GrowingTrajectory
from core.pipeline.growing_model import METHODS, GrowingModel
from core.pipeline.mapper import MappingOptions
from core.pipeline.modeller import ModellingOptions, model_so_far
from core.sensing import Scan, SonarRing
from core.topology import Model

MOVED = 0.1
"""Metres (two cells) by which a pose may have moved before the drive is mapped again."""
RENEWED_SHARE = 0.25
"""The drive has to be longer by this share before it is mapped again: five folds' work in all."""


class GrowingDrive:
    """State + scan -> state, and a model at any time."""

    def __init__(self, ring: SonarRing, options: ModellingOptions | None = None) -> None:
        """An empty drive.

        Raises:
            InputError: options that only a whole log can have.
        """
        self.options = options or ModellingOptions()
        if self.options.regions is not None or self.options.mode == "offline":
            raise InputError("a drive that has not ended is modelled autonomously")
        self._ring = ring
        self._scans: list[Scan] = []
        self._trajectory = GrowingTrajectory(ring)
        self._growing = self._fresh()
        self._renewed_at = 0.0

    def __len__(self) -> int:
        return len(self._scans)

    @property
    def driven(self) -> float:
        """Metres so far."""
        return self._growing.driven

    def add(self, scan: Scan) -> bool:
        """Takes in a scan; returns whether a modelling step was taken."""
        pose = scan.odometry if self.options.odometry == "raw" else self._trajectory.add(scan)
        self._scans.append(scan)
        stepped = self._growing.add(scan, pose)
        if stepped and self._should_renew():
            self._renew()
        return stepped

    @property
    def pose(self) -> FloatArray:
        """(3,) of the last scan, in the map's frame."""
        return self._growing.pose

    def model(self, name: str) -> Model:
        """The model of the drive as if it ended now; it can go on.

        Raises:
            MapError: the sonar has not heard anything yet.
        """
        return model_so_far(name, self._growing, self.options)

    def _should_renew(self) -> bool:
        longer = self.driven >= (1 + RENEWED_SHARE) * self._renewed_at
        return self._trajectory.moved > MOVED and longer

    def _renew(self) -> None:
        """Folds the drive again at the poses as they are now."""
        poses = self._trajectory.told()
        self._growing = self._fresh()
        for scan, pose in zip(self._scans, poses, strict=True):
            self._growing.add(scan, pose)
        self._renewed_at = self.driven

    def _fresh(self) -> GrowingModel:
        mapping = MappingOptions(self.options.mapping, self.options.resolution)
        return GrowingModel(self._ring, mapping, METHODS[self.options.method])
