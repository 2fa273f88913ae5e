"""Which cells of the grid a sonar beam covers, and with what sound pressure.

Everything that depends on the transducer only - the limits of the sector and the directivity of
eq. (4) - is computed once per ring (`BeamFootprints`); the compiled `cells_of_beam` places it at a
reading's exact pose.
"""

from __future__ import annotations

from dataclasses import dataclass

import numba
import numpy as np

from core.geometry import FloatArray, IntArray, compose
from core.mapping.occupancy_grid import GridGeometry
from core.sensing import RobotLog, SonarRing, Trajectory
from core.sensing.beam import directivity

DIRECTIVITY_STEPS = 256
NEAREST = 0.1
"""Metres; closer to the transducer eq. (4) grows without bound and is held at this distance."""


@dataclass(frozen=True)
class BeamFootprints:
    """The sectors of a ring's sonars.

    Attributes:
        mounting: (S, 3) poses of the transducers in the robot's frame.
        half_beam: (S,) half of the beam angle, radians.
        gain: (S, DIRECTIVITY_STEPS + 1) directivity over sin^2(theta) / sin^2(half beam).
    """

    mounting: FloatArray
    half_beam: FloatArray
    gain: FloatArray

    @classmethod
    def of(cls, ring: SonarRing) -> BeamFootprints:
        """The footprints of a ring."""
        half = np.array([s.beam_width / 2 for s in ring.sonars])
        steps = np.linspace(0.0, 1.0, DIRECTIVITY_STEPS + 1)
        gain = [
            directivity(np.arcsin(np.sqrt(steps) * np.sin(h)), s.beam_width)
            for h, s in zip(half, ring.sonars, strict=True)
        ]
        mounting = np.array([(s.x, s.y, s.heading) for s in ring.sonars])
        return cls(mounting, half, np.array(gain))


@dataclass(frozen=True)
class Readings:
    """The echoes of a drive, one after the other.

    Attributes:
        pose: (M, 3) world pose of the transducer at the reading.
        range_m: (M,) metres.
        sonar: (M,) index of the sonar in the ring.
        scan: (M,) index of the scan in the log.
    """

    pose: FloatArray
    range_m: FloatArray
    sonar: IntArray
    scan: IntArray

    def __len__(self) -> int:
        return len(self.range_m)


def readings_of(log: RobotLog, trajectory: Trajectory) -> Readings:
    """All fresh echoes within their sonar's range limits, at the poses of the trajectory."""
    low = np.array([s.min_range for s in log.ring.sonars])
    high = np.array([s.max_range for s in log.ring.sonars])
    with np.errstate(invalid="ignore"):
        usable = log.fresh & (log.ranges >= low) & (log.ranges < high)
    scan, sonar = np.nonzero(usable)
    mounting = BeamFootprints.of(log.ring).mounting
    pose = compose(trajectory.poses[scan], mounting[sonar])
    return Readings(pose, log.ranges[scan, sonar], sonar.astype(np.int64), scan.astype(np.int64))


@numba.njit(cache=True)
def cells_of_beam(
    pose: FloatArray,
    reach: float,
    half: float,
    gain: FloatArray,
    frame: FloatArray,
    shape: IntArray,
    cells: IntArray,
    distance: FloatArray,
    pressure: FloatArray,
) -> int:
    """Fills `cells`, `distance` and `pressure` with the cells of one beam and returns their number.

    Args:
        pose: (3,) of the transducer.
        reach: metres from the transducer to the farthest cell wanted.
        half: half of the beam angle, radians.
        gain: directivity table of the sonar.
        frame: (3,) x and y of the grid's corner and its resolution.
        shape: (2,) rows and columns.
        cells: flat indices; all three outputs must hold every cell of the sector.
        distance: metres from the transducer to the cell's centre.
        pressure: eq. (4) at the cell's centre.
    """
    x, y, heading = pose[0], pose[1], pose[2]
    corner_x, corner_y, resolution = frame[0], frame[1], frame[2]
    x_low, x_high, y_low, y_high = x, x, y, y
    for k in range(5):
        angle = heading - half + k * half / 2
        px, py = x + reach * np.cos(angle), y + reach * np.sin(angle)
        x_low, x_high = min(x_low, px), max(x_high, px)
        y_low, y_high = min(y_low, py), max(y_high, py)
    bulge = resolution + reach * (1 - np.cos(half / 4))
    col_0 = max(0, int(np.floor((x_low - bulge - corner_x) / resolution)))
    col_1 = min(shape[1] - 1, int((x_high + bulge - corner_x) / resolution))
    row_0 = max(0, int(np.floor((y_low - bulge - corner_y) / resolution)))
    row_1 = min(shape[0] - 1, int((y_high + bulge - corner_y) / resolution))
    cos, sin = np.cos(heading), np.sin(heading)
    cos_half, sin2_half = np.cos(half), np.sin(half) ** 2
    steps = len(gain) - 1
    count = 0
    for row in range(row_0, row_1 + 1):
        dy = corner_y + (row + 0.5) * resolution - y
        for col in range(col_0, col_1 + 1):
            dx = corner_x + (col + 0.5) * resolution - x
            squared = dx * dx + dy * dy
            along = dx * cos + dy * sin
            if squared > reach * reach or along <= 0 or along * along < cos_half**2 * squared:
                continue
            off_axis = (1 - along * along / squared) / sin2_half
            cells[count] = row * shape[1] + col
            distance[count] = np.sqrt(squared)
            pressure[count] = gain[int(off_axis * steps + 0.5)] / max(squared, NEAREST**2)
            count += 1
    return count


def beam_capacity(reach: float, half: float, resolution: float) -> int:
    """An upper bound of the number of cells in a sector."""
    side = int(2 * reach / resolution) + 4
    share = min(1.0, half / np.pi + 0.25)
    return int(side * side * share) + 16


def grid_around(
    log: RobotLog, trajectory: Trajectory, readings: Readings, resolution: float
) -> GridGeometry:
    """A grid that holds every cell that the readings and the robot's footprint can speak of."""
    margin = max(log.ring.robot_radius, 0.0) + 2 * resolution
    points = trajectory.poses[:, :2]
    if len(readings):
        reach = readings.range_m[:, None] + 2 * resolution
        points = np.concatenate(
            (points, readings.pose[:, :2] - reach, readings.pose[:, :2] + reach)
        )
    return GridGeometry.around(points, margin, resolution)


def frame_of(geometry: GridGeometry) -> tuple[FloatArray, IntArray]:
    """A grid's corner and resolution, and its shape, as the compiled loops take them."""
    frame = np.array([geometry.origin[0], geometry.origin[1], geometry.resolution])
    return frame, np.array(geometry.shape, np.int64)
