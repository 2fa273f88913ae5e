"""Drift correction on a real corridor log: errors and free space against laser-derived poses.

    python tests/benchmarks/drift_real.py --data SHARED

SHARED/logs/corridor_test1 holds the log's text files (eight sonars, odometry, poses by laser scan
matching); how they are read is described in `tests/core/log_readers/corridor_test1.yaml`. For each
way to take the odometry: position error in metres along the drive (mean, end), heading error at its
end in degrees, and the overlap of the map's free space with that of the map at the laser's poses - as
it lies, and after one rigid fit of the poses, since the drive's first metres fix the frame.
"""

from __future__ import annotations

import argparse
import math
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np

from core.evaluation.trajectory_error import trajectory_error
from core.geometry import FloatArray, compose, rigid_fit
from core.log_readers import read_log
from core.mapping import OccupancyGrid
from core.pipeline.corrected_drive import CHOICES, corrected_drive
from core.pipeline.mapper import map_log
from core.sensing import RobotLog, Trajectory

LOG_YAML = Path(__file__).parents[1] / "core" / "log_readers" / "corridor_test1.yaml"


def corridor_log(data: Path) -> RobotLog:
    """The log, its text files and their description put side by side."""
    with tempfile.TemporaryDirectory() as name:
        for file in (data / "logs" / "corridor_test1").glob("*.txt"):
            shutil.copy(file, name)
        shutil.copy(LOG_YAML, Path(name) / "log.yaml")
        return read_log(Path(name)).log


def free_overlap(one: OccupancyGrid, other: OccupancyGrid) -> float:
    """Cells that are free in both maps over those that are free in either."""
    cells = one.geometry.cell_of(other.geometry.world_of(np.argwhere(other.free)))
    cells = cells[one.geometry.contains(cells)]
    shared = int(one.free[cells[:, 0], cells[:, 1]].sum())
    return shared / (int(one.free.sum()) + int(other.free.sum()) - shared)


def scores(
    log: RobotLog, poses: FloatArray, truth: FloatArray, laser: OccupancyGrid
) -> list[float]:
    """Mean and final position error, final heading error, free overlap as it lies and fitted."""
    error = trajectory_error(poses, truth)
    turned = math.degrees(abs(error.heading_at_end))
    fitted = compose(rigid_fit(truth[:, :2], poses[:, :2]), poses)
    maps = (map_log(log, Trajectory.at(log.t, at)).grid for at in (poses, fitted))
    return [error.mean, error.at_end, turned, *(free_overlap(grid, laser) for grid in maps)]


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True)
    log = corridor_log(parser.parse_args().data)
    if log.truth is None:
        parser.error("the log has no laser-derived poses (truth_laser_icp.txt)")
    laser = map_log(log, Trajectory.at(log.t, log.truth)).grid
    sys.stdout.write("odometry     mean m   end m   end deg   free overlap   after a rigid fit\n")
    for choice in CHOICES:
        drive = corrected_drive(log.without_truth(), choice)
        truth = log.truth[slice(*drive.whole.part)]
        row = scores(drive.log, drive.trajectory.poses, truth, laser)
        sys.stdout.write(
            f"{choice:<12}{row[0]:7.3f}{row[1]:8.3f}{row[2]:10.1f}{row[3]:15.3f}{row[4]:20.3f}\n"
        )
        sys.stdout.write("".join(f"    {sentence}\n" for sentence in drive.whole.sentences))


if __name__ == "__main__":
    main()
