"""The readings of one time step, seen from the robot's last pose of the step.

This is the default's local map: no grid, but every reading with the pose of its sonar relative to
where the robot is now. Odometry over a few metres is good enough for that.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from core.geometry import FloatArray, IntArray, between, travelled, wrap_angle
from core.localization.sonar_likelihood import NO_ECHO, reading_codes
from core.sensing import RobotLog


@dataclass(frozen=True)
class SegmentConfig:
    """Which scans of a step are looked at; readings taken close together tell the same.

    Attributes:
        gap: metres of travel after which a scan is taken.
        gap_angle: radians of turning after which a scan is taken.
    """

    gap: float = 0.2
    gap_angle: float = 0.4


@dataclass(frozen=True)
class Segment:
    """Readings of a step in the frame of its last pose, newest first (all arrays of length M).

    Attributes:
        codes: reading codes.
        x, y: position of the sonar, metres.
        heading: direction of the sonar, radians.
        sonar: number of the sonar in its ring.
        ranges: metres, NaN = no echo.
        odometry: (3,) motion since the last pose of the step before, in that pose's frame.
        distance: metres driven since then.
        turned: radians turned since then, whatever the direction.
    """

    codes: IntArray
    x: FloatArray
    y: FloatArray
    heading: FloatArray
    sonar: IntArray
    ranges: FloatArray
    odometry: FloatArray
    distance: float
    turned: float

    def __len__(self) -> int:
        return len(self.codes)

    def newest(self, share: float) -> Segment:
        """The newest share of the readings alone."""
        part = slice(0, round(share * len(self)))
        return replace(
            self,
            codes=self.codes[part],
            x=self.x[part],
            y=self.y[part],
            heading=self.heading[part],
            sonar=self.sonar[part],
            ranges=self.ranges[part],
        )

    def echo_points(self) -> FloatArray:
        """Where the echoes came from, on the axes of the beams: (K, 2) in the frame of the segment."""
        heard = self.codes != NO_ECHO
        r, a = self.ranges[heard], self.heading[heard]
        return np.stack((self.x[heard] + r * np.cos(a), self.y[heard] + r * np.sin(a)), axis=-1)


def segment_of(part: RobotLog, config: SegmentConfig, first: bool) -> Segment:
    """The segment of the scans of one step.

    Args:
        part: the scans from the last one of the step before (which is not read again, unless
            `first`) to the last one of this step.
        config: which scans to take.
        first: the first scan belongs to no step before.
    """
    poses = part.odometry
    scans = _spread_scans(poses, config, 0 if first else 1)
    mounts = np.array([(s.x, s.y, s.heading) for s in part.ring.sonars]).reshape(-1, 3)
    seen = between(poses[-1], poses[scans])
    cos, sin = np.cos(seen[:, 2])[:, None], np.sin(seen[:, 2])[:, None]
    x = seen[:, :1] + cos * mounts[:, 0] - sin * mounts[:, 1]
    y = seen[:, 1:2] + sin * mounts[:, 0] + cos * mounts[:, 1]
    heading = seen[:, 2:] + mounts[:, 2]
    ranges, told = part.ranges[scans], part.fresh[scans]
    sonar = np.broadcast_to(np.arange(len(part.ring)), ranges.shape)
    return Segment(
        reading_codes(ranges[told]),
        x[told],
        y[told],
        heading[told],
        sonar[told],
        ranges[told],
        between(poses[0], poses[-1]),
        float(travelled(poses)[-1]),
        float(np.abs(wrap_angle(np.diff(poses[:, 2]))).sum()),
    )


def _spread_scans(poses: FloatArray, config: SegmentConfig, start: int) -> IntArray:
    """Scans spread along the drive, the last one first."""
    taken: list[int] = []
    for i in range(len(poses) - 1, start - 1, -1):
        if taken:
            dx, dy, turn = poses[i] - poses[taken[-1]]
            if np.hypot(dx, dy) < config.gap and abs(wrap_angle(turn)) < config.gap_angle:
                continue
        taken.append(i)
    return np.array(taken, np.int64)
