"""A robot log: what the robot sensed, scan by scan."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from core.errors import InputError
from core.geometry import BoolArray, FloatArray, IntArray, travelled
from core.sensing.ring import SonarRing


@dataclass(frozen=True)
class Scan:
    """One scan: time (s), odometry pose (3,), ranges (S,) in metres with NaN = no echo, and which
    of them were measured anew (S,)."""

    t: float
    odometry: FloatArray
    ranges: FloatArray
    fresh: BoolArray


@dataclass(frozen=True)
class RobotLog:
    """A drive.

    Attributes:
        name: what the user calls it.
        ring: where the sonars sit.
        t: (N,) seconds, increasing.
        odometry: (N, 3) poses in the odometry frame.
        ranges: (N, S) metres; NaN = no echo.
        fresh: (N, S) False where a value only repeats an earlier measurement (sonars that fire in
            turn latch their last value); such readings say nothing new and carry a wrong pose.
        truth: (N, 3) true poses or None. For evaluation only: no algorithm may read it.
    """

    name: str
    ring: SonarRing
    t: FloatArray
    odometry: FloatArray
    ranges: FloatArray
    fresh: BoolArray
    truth: FloatArray | None = None

    def __post_init__(self) -> None:
        n, s = len(self.t), len(self.ring)
        if self.odometry.shape != (n, 3) or self.ranges.shape != (n, s):
            raise InputError(
                f"log {self.name!r}: {n} times, odometry {self.odometry.shape}, ranges {self.ranges.shape} "
                f"for {s} sonars do not fit together"
            )

    def __len__(self) -> int:
        return len(self.t)

    def __iter__(self) -> Iterator[Scan]:
        for i in range(len(self)):
            yield self.scan(i)

    def scan(self, index: int) -> Scan:
        """The scan number `index`."""
        return Scan(
            float(self.t[index]), self.odometry[index], self.ranges[index], self.fresh[index]
        )

    def slice(self, start: int, stop: int) -> RobotLog:
        """The scans `start`..`stop` (half-open)."""
        return self.taken(np.arange(len(self))[start:stop])

    def taken(self, part: IntArray) -> RobotLog:
        """The scans with the given indices."""
        return replace(
            self,
            t=self.t[part],
            odometry=self.odometry[part],
            ranges=self.ranges[part],
            fresh=self.fresh[part],
            truth=None if self.truth is None else self.truth[part],
        )

    def without_truth(self) -> RobotLog:
        """The same drive as an algorithm may see it."""
        return replace(self, truth=None)

    @property
    def duration_s(self) -> float:
        """Seconds from the first scan to the last."""
        return float(self.t[-1] - self.t[0]) if len(self) else 0.0

    @property
    def distance_m(self) -> float:
        """Metres driven according to the odometry."""
        return float(travelled(self.odometry)[-1]) if len(self) else 0.0


def join(first: RobotLog, second: RobotLog) -> RobotLog:
    """Two logs of one drive as one; the second must go on where the first ends.

    Raises:
        InputError: the rings differ or the second log does not start after the first one's end.
    """
    if first.ring != second.ring:
        raise InputError(f"{second.name!r} has another sonar ring than {first.name!r}")
    if len(first) and len(second) and second.t[0] <= first.t[-1]:
        raise InputError(
            f"{second.name!r} starts at {second.t[0]:.2f} s, before {first.name!r} ends "
            f"({first.t[-1]:.2f} s): they are not one drive"
        )
    both = first.truth is not None and second.truth is not None
    return RobotLog(
        first.name,
        first.ring,
        np.concatenate((first.t, second.t)),
        np.concatenate((first.odometry, second.odometry)),
        np.concatenate((first.ranges, second.ranges)),
        np.concatenate((first.fresh, second.fresh)),
        np.concatenate((first.truth, second.truth)) if both else None,  # type: ignore[arg-type]
    )
