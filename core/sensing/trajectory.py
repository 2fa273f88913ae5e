"""The poses that a map is made at."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from core.errors import InputError
from core.geometry import FloatArray, IntArray
from core.sensing.robot_log import RobotLog

HEADER = ("t", "x", "y", "heading", "sigma_xy", "sigma_heading")


@dataclass(frozen=True)
class Trajectory:
    """One pose per scan in the map's frame.

    Attributes:
        t: (N,) seconds.
        poses: (N, 3).
        sigma_xy: (N,) standard deviation of the position, metres.
        sigma_heading: (N,) standard deviation of the heading, radians.
    """

    t: FloatArray
    poses: FloatArray
    sigma_xy: FloatArray
    sigma_heading: FloatArray

    def __len__(self) -> int:
        return len(self.t)

    @classmethod
    def at(cls, t: FloatArray, poses: FloatArray) -> Trajectory:
        """A trajectory taken as exact."""
        return cls(t, poses, np.zeros(len(t)), np.zeros(len(t)))

    @classmethod
    def from_odometry(cls, log: RobotLog) -> Trajectory:
        """The odometry as it is in the log."""
        return cls.at(log.t, log.odometry)

    def taken(self, part: IntArray) -> Trajectory:
        """The poses with the given indices."""
        return Trajectory(
            self.t[part], self.poses[part], self.sigma_xy[part], self.sigma_heading[part]
        )

    def write_csv(self, path: Path) -> None:
        """Writes `t,x,y,heading,sigma_xy,sigma_heading`, one row per scan."""
        table = np.column_stack((self.t, self.poses, self.sigma_xy, self.sigma_heading))
        rows = "\n".join(
            ",".join(f"{value:.6g}" if i else f"{value:.4f}" for i, value in enumerate(row))
            for row in table
        )
        path.write_text(",".join(HEADER) + "\n" + rows + "\n", encoding="utf-8")

    @classmethod
    def read_csv(cls, path: Path) -> Trajectory:
        """Reads what `write_csv` wrote.

        Raises:
            InputError: the file is missing, has other columns or a value that is no number.
        """
        try:
            with path.open(encoding="utf-8", newline="") as file:
                rows = list(csv.reader(file))
        except OSError as error:
            raise InputError(f"{path.name}: {error.strerror}") from error
        if not rows or tuple(rows[0]) != HEADER:
            raise InputError(f"{path.name}: the first line must be {','.join(HEADER)}")
        try:
            table = np.array(rows[1:], float).reshape(-1, len(HEADER))
        except ValueError as error:
            raise InputError(f"{path.name}: {error}") from error
        return cls(table[:, 0], table[:, 1:4], table[:, 4], table[:, 5])
