"""Drift correction on the shared simulated homes: trajectories and maps, before and after.

    python tests/benchmarks/drift_homes.py [--data ../shared] [--only mapbad]

For each mapping log: position error in metres along the drive (mean, median, end) and heading error at
the end in degrees, raw and corrected; then the scores of the CEMAL map at raw, corrected and true poses.
"""

from __future__ import annotations

import argparse
import math
import resource
import sys
import time
from pathlib import Path
from types import ModuleType

import numpy as np

from core.geometry import wrap_angle
from core.log_readers import read_log
from core.mapping.cemal import cemal_map
from core.pipeline.odometry import trajectory_for
from core.sensing import RobotLog, Trajectory

COLUMNS = (
    "precision_1",
    "precision_2",
    "recall_1",
    "recall_2",
    "free_iou",
    "leak_m2",
    "doors_blocked",
    "leaks",
)


def scorer(homes: Path) -> tuple[ModuleType, ModuleType]:
    """The independent scorer that lies beside the homes."""
    sys.path.insert(0, str(homes))
    import common  # type: ignore[import-not-found]
    import score_map  # type: ignore[import-not-found]

    return score_map, common


def map_scores(log: RobotLog, poses: np.ndarray, homes: Path) -> list[float]:
    """Scores of the map made at the poses, in the order of COLUMNS."""
    score_map, common = scorer(homes)
    grid = cemal_map(log.without_truth(), Trajectory.at(log.t, poses)).grid
    geometry = grid.geometry
    seen = common.Grid(grid.occupied, grid.free, geometry.resolution, geometry.origin)
    home = log.name.split()[0]
    scores = score_map.score(seen, common.load_truth(homes / "truth" / f"{home}.npz"))
    return [float(scores[column]) for column in COLUMNS]


def pose_errors(poses: np.ndarray, truth: np.ndarray) -> str:
    """Mean, median and final position error, final heading error."""
    off = np.hypot(*(poses - truth)[:, :2].T)
    turned = math.degrees(float(wrap_angle(poses[-1, 2] - truth[-1, 2])))
    return f"{off.mean():.3f} {np.median(off):.3f} {off[-1]:.3f} {turned:6.1f}"


def main() -> None:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    root = Path(__file__).resolve().parents[2]
    parser.add_argument("--data", type=Path, default=root.parent / "shared")
    parser.add_argument("--only", choices=("map", "mapbad"))
    chosen = parser.parse_args()
    homes = chosen.data / "homes"
    for kind in ("mapbad", "map"):
        if chosen.only not in (None, kind):
            continue
        table: dict[str, list[list[float]]] = {"raw": [], "corrected": [], "true": []}
        for path in sorted((homes / "logs").glob(f"*_{kind}.jsonl.gz")):
            log = read_log(path).log
            assert log.truth is not None
            start = time.process_time()
            result = trajectory_for(log)
            seconds = time.process_time() - start
            sys.stdout.write(
                f"{log.name:<16} raw {pose_errors(log.odometry, log.truth)}  now "
                f"{pose_errors(result.trajectory.poses, log.truth)}  ({result.used}, {seconds:.1f} s cpu)\n"
            )
            sys.stdout.flush()
            for name, poses in (
                ("raw", log.odometry),
                ("corrected", result.trajectory.poses),
                ("true", log.truth),
            ):
                table[name].append(map_scores(log, poses, homes))
        sys.stdout.write(f"{kind:<10}" + "".join(f"{column:>14}" for column in COLUMNS) + "\n")
        for name, rows in table.items():
            means = "".join(f"{value:14.3f}" for value in np.mean(rows, axis=0))
            sys.stdout.write(f"{name:<10}{means}\n")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    sys.stdout.write(f"peak memory {peak:.0f} MB\n")


if __name__ == "__main__":
    main()
