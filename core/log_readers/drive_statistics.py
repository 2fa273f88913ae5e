"""Figures of a drive that its report is made of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray, IntArray, wrap_angle
from core.log_readers.log_report import Gap, Jump
from core.sensing.robot_log import RobotLog


@dataclass(frozen=True)
class DriveConfig:
    """What counts as a gap or a jump.

    Attributes:
        gap_factor: a gap is this many times the median time between scans ...
        gap_s: ... and at least this long.
        jump_m: a jump is farther than this ...
        jump_speed: ... and faster than this, m/s; or
        jump_rad: turns more than this ...
        jump_rate: ... and faster than this, rad/s.
        listed: so many gaps and jumps are listed, the largest first.
    """

    gap_factor: float = 5.0
    gap_s: float = 1.0
    jump_m: float = 0.3
    jump_speed: float = 2.5
    jump_rad: float = 0.6
    jump_rate: float = 6.3
    listed: int = 10


@dataclass(frozen=True)
class DriveStatistics:
    """Step by step (N-1,): time, distance, absolute turn; and what is odd in them."""

    seconds: FloatArray
    metres: FloatArray
    radians: FloatArray
    extent_m: float
    gap_steps: IntArray
    jump_steps: IntArray

    @property
    def median_s(self) -> float:
        """Median time between scans, 0 with one scan."""
        return float(np.median(self.seconds)) if len(self.seconds) else 0.0


def drive_statistics(log: RobotLog, config: DriveConfig = DriveConfig()) -> DriveStatistics:
    """Steps, gaps and jumps of a drive."""
    seconds = np.diff(log.t)
    metres = np.hypot(np.diff(log.odometry[:, 0]), np.diff(log.odometry[:, 1]))
    radians = np.abs(wrap_angle(np.diff(log.odometry[:, 2])))
    median = float(np.median(seconds)) if len(seconds) else 0.0
    gaps = seconds > max(config.gap_s, config.gap_factor * median)
    jumps = (metres > config.jump_m) & (metres > config.jump_speed * seconds)
    jumps |= (radians > config.jump_rad) & (radians > config.jump_rate * seconds)
    extent = float(np.hypot(*np.ptp(log.odometry[:, :2], axis=0))) if len(log) else 0.0
    return DriveStatistics(
        seconds, metres, radians, extent, np.flatnonzero(gaps), np.flatnonzero(jumps)
    )


def longest_gaps(log: RobotLog, drive: DriveStatistics, listed: int) -> tuple[Gap, ...]:
    """The longest gaps, longest first."""
    order = drive.gap_steps[np.argsort(-drive.seconds[drive.gap_steps], kind="stable")][:listed]
    return tuple(
        Gap(float(log.t[i]), float(drive.seconds[i]), float(drive.metres[i])) for i in order
    )


def largest_jumps(log: RobotLog, drive: DriveStatistics, listed: int) -> tuple[Jump, ...]:
    """The largest jumps, farthest first."""
    order = drive.jump_steps[np.argsort(-drive.metres[drive.jump_steps], kind="stable")][:listed]
    return tuple(
        Jump(float(log.t[i + 1]), float(drive.metres[i]), float(drive.radians[i])) for i in order
    )
