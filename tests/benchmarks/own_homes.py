"""CEMAL on the product's own homes: `python tests/benchmarks/own_homes.py [NUMBER_OF_HOMES]`.

Homes random-1 ... random-99 are there to choose parameters; what is reported comes from the paper
home and from random-1001 onwards, which nothing was chosen on. Each home is driven once; the map is
made at the true poses and at the calibrated odometry, whose frame is laid on the truth by one rigid
fit (drift bends a map and counts; where its frame lies does not).
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np

from core.evaluation import GroundTruth, MapMetrics, aligned_grid, alignment, map_metrics
from core.geometry import FloatArray, travelled
from core.mapping.cemal import cemal_map
from core.sensing import RobotLog, Trajectory
from core.simulation import build_home, simulate, truth_of

FIRST_REPORTED = 1001
HOMES = 8
DRIVE_SEED = 1001
COLUMNS = (
    ("precision_1", "prec 1"),
    ("precision_2", "prec 2"),
    ("recall_1", "rec 1"),
    ("recall_2", "rec 2"),
    ("free_iou", "IoU"),
    ("leak_m2", "leak m2"),
    ("doors_blocked", "blocked"),
    ("leaks", "leaks"),
)
TARGETS = {
    "true": {"precision_1": 0.93, "recall_1": 0.79, "free_iou": 0.90, "doors_blocked": 0},
    "calibrated": {"precision_2": 0.90, "recall_2": 0.85, "free_iou": 0.86, "doors_blocked": 0},
}


@dataclass(frozen=True)
class Row:
    """One home, mapped at one kind of poses."""

    home: str
    poses: str
    metrics: MapMetrics


def main(count: int) -> None:
    rows: list[Row] = []
    print("home          rooms  m    scans " + " ".join(f"{name:>8s}" for _, name in COLUMNS))
    for name in ["paper", *(f"random-{FIRST_REPORTED + i}" for i in range(count - 1))]:
        home = build_home(name)
        log = simulate(home, seed=DRIVE_SEED)
        assert log.truth is not None
        metres = travelled(log.truth)[-1]
        truth = ground_truth(name, log)
        for poses, at in (("true", log.truth), ("calibrated", log.odometry)):
            row = Row(name, poses, metrics_at(log, at, truth))
            rows.append(row)
            start = f"{name:13s} {len(home.rooms):3d} {metres:5.0f} {len(log):6d} "
            print(start + line(row) + f"  {poses}", flush=True)
    for poses, targets in TARGETS.items():
        mine = [row for row in rows if row.poses == poses]
        print(f"\n{poses} poses, {len(mine)} homes: mean / worst (target)")
        for field, _ in COLUMNS:
            values = [float(getattr(row.metrics, field)) for row in mine]
            lower_is_better = field in ("leak_m2", "doors_blocked", "leaks")
            worst = max(values) if lower_is_better else min(values)
            wanted = f"   (target {targets[field]})" if field in targets else ""
            print(f"  {field:14s} {np.mean(values):6.3f} / {worst:6.3f}{wanted}")


def ground_truth(name: str, log: RobotLog) -> GroundTruth:
    truth = truth_of(build_home(name))
    return GroundTruth(
        truth.geometry,
        truth.occupied,
        truth.free,
        truth.explored(log),
        truth.rooms,
        truth.names,
        truth.door_gaps,
    )


def metrics_at(log: RobotLog, poses: FloatArray, truth: GroundTruth) -> MapMetrics:
    assert log.truth is not None
    result = cemal_map(log.without_truth(), Trajectory.at(log.t, poses))
    return map_metrics(aligned_grid(result.grid, alignment(log.truth, poses)), truth)


def line(row: Row) -> str:
    return " ".join(f"{getattr(row.metrics, field):8.3f}" for field, _ in COLUMNS)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else HOMES)
