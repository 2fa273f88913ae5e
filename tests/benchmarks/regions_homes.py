"""Regions found on drives through homes: autonomous by default, as in the paper, and with k given.

    python tests/benchmarks/regions_homes.py [--homes 20] [--first 1001] [--jobs 2] [--odometry raw]
                                             [--methods paper] [--drives 10]
    python tests/benchmarks/regions_homes.py --data SHARED

The first form drives through the paper home and random-1001 onwards, which nothing was chosen on
(random-1 ... random-999 are there to choose), with the errors of calibrated odometry; the frame of the
trajectory is laid on the truth by one rigid fit. The second one takes the drives and the truth of an
independent simulator from SHARED/homes. The odometry is corrected as it is by default, or used raw.
`--drives` goes through the paper home more than once (seeds 1001, 1002, ...), and tells for each drive
how well its best single node meets every room (IoU).

"upper ref." is no method: it knows the true map and the true rooms, and divides each room into as few
and as large regions as hidden pairs allow. No method that keeps the limit can be expected to reach a
higher ARI; furnished rooms hide more than that, and have to be cut.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from multiprocessing import Pool
from pathlib import Path

import numpy as np

from core.evaluation import GroundTruth
from core.evaluation.ground_truth import aligned, alignment
from core.evaluation.region_metrics import RegionMetrics, region_metrics
from core.geometry import FloatArray
from core.log_readers.registry import read_log
from core.mapping import FREE, OCCUPIED, UNKNOWN, GridGeometry, OccupancyGrid
from core.pipeline.modeller import ModellingOptions, model_log
from core.pipeline.odometry import OdometryChoice
from core.segmentation.convex_grouping import GroupingConfig, grouped
from core.segmentation.small_cells import small_cells
from core.sensing import RobotLog
from core.simulation import build_home, simulate, truth_of

RESOLUTION = 0.05
SHARED_HOMES = ("home21", "home22", "home23", "home24")
DRIVE_SEED = 1001
METHODS = {
    "autonomous": ModellingOptions(),
    "paper": ModellingOptions(method="paper"),
    "k = 10": ModellingOptions(regions=10),
}
UPPER = "upper ref."
PAPER_HOME = "paper"
OWN_ROOMS, OWN_NODE = ("bedroom", "study", "child's room", "kitchen"), 0.7
"""The rooms that are nodes of their own in the paper (5.1), and the IoU from which one is."""
MOST_HIDDEN = 0.2
"""Share of hidden pairs that every region of a home should keep to."""
CROSSING_COST = 100.0
"""Of a pair of two rooms in one region of the upper reference: it keeps every room apart."""


@dataclass(frozen=True)
class Row:
    """One home, divided by one method."""

    home: str
    method: str
    metrics: RegionMetrics
    seconds: float

    @property
    def right_number(self) -> bool:
        """Whether there are at least as many nodes as rooms and at most twice as many."""
        return self.metrics.rooms_true <= self.metrics.count <= 2 * self.metrics.rooms_true


COLUMNS: dict[str, tuple[Callable[[Row], float], Callable[[Iterable[float]], float]]] = {
    "purity": (lambda row: row.metrics.purity, min),
    "ARI": (lambda row: row.metrics.ari, min),
    "hidden mean": (lambda row: row.metrics.hidden_mean, max),
    "hidden max": (lambda row: row.metrics.hidden_max, max),
    "merged IoU": (lambda row: row.metrics.merged_iou_mean, min),
    "coverage": (lambda row: row.metrics.coverage, min),
    "regions": (lambda row: row.metrics.count, max),
    "seconds": (lambda row: row.seconds, max),
}
"""What is shown of a home, and which of two values is the worse."""


def own_home(
    name: str, odometry: OdometryChoice, methods: list[str], seed: int = DRIVE_SEED
) -> list[Row]:
    """A home of the product's own simulator."""
    home = build_home(name)
    log = simulate(home, seed=seed)
    assert log.truth is not None
    true = truth_of(home)
    truth = GroundTruth(
        true.geometry, true.occupied, true.free, true.explored(log), true.rooms, true.names,
        true.door_gaps,
    )  # fmt: skip
    return rows(name, log, truth, log.truth, odometry, methods)


def shared_home(folder: str, name: str, odometry: OdometryChoice, methods: list[str]) -> list[Row]:
    """A home of the independent simulator."""
    stored = np.load(Path(folder) / "truth" / f"{name}.npz", allow_pickle=False)
    meta = json.loads(str(stored["meta"]))
    shape = stored["occupied"].shape
    geometry = GridGeometry(RESOLUTION, (*meta["origin"][:2], 0.0), (shape[0], shape[1]))
    truth = GroundTruth(
        geometry, stored["occupied"], stored["free"], stored["explored"],
        stored["rooms"].astype(np.int64), tuple(meta["rooms"]), np.zeros((0, 4)),
    )  # fmt: skip
    log = read_log(Path(folder) / "logs" / f"{name}_map.jsonl.gz").log
    return rows(name, log, truth, None, odometry, methods)


def rows(
    name: str,
    log: RobotLog,
    truth: GroundTruth,
    true_poses: FloatArray | None,
    odometry: OdometryChoice,
    methods: list[str],
) -> list[Row]:
    """Methods on one drive; without true poses (n, 3) the frames of log and truth are one."""
    found = []
    for method in methods:
        start = time.process_time()
        model = model_log(log.without_truth(), replace(METHODS[method], odometry=odometry))
        seconds = time.process_time() - start
        geometry = model.grid.geometry
        if true_poses is not None and model.trajectory is not None:
            geometry = aligned(geometry, alignment(true_poses, model.trajectory.poses))
        found.append(Row(name, method, region_metrics(model.regions, geometry, truth), seconds))
    start = time.process_time()
    regions = upper_reference(truth)
    seconds = time.process_time() - start
    found.append(Row(name, UPPER, region_metrics(regions, truth.geometry, truth), seconds))
    return found


def upper_reference(truth: GroundTruth) -> np.ndarray:
    """Regions (rows, cols) of the true map: the true rooms in as few convex parts as were found."""
    floor = truth.free & truth.explored & (truth.rooms > 0)
    state = np.where(floor, FREE, np.where(truth.occupied, OCCUPIED, UNKNOWN)).astype(np.uint8)
    grid, resolution = OccupancyGrid(truth.geometry, state), truth.geometry.resolution
    rooms = np.unique(truth.rooms[floor])
    cells = np.zeros(floor.shape, np.int64)
    for room in rooms:
        part = small_cells(floor & (truth.rooms == room), truth.occupied, grid)
        cells[part > 0] = part[part > 0] + cells.max()
    config = GroupingConfig(most_hidden=MOST_HIDDEN, hidden_cost=0.0, apart_cost=CROSSING_COST)
    rng = np.random.default_rng(0)
    return grouped(cells, truth.rooms, truth.occupied, resolution, config, rng)


def line(row: Row) -> str:
    """One row of the table."""
    values = " ".join(f"{get(row):11.2f}" for get, _ in COLUMNS.values())
    return f"{row.home:12s} {row.method:11s} {row.metrics.rooms_true:5d} {values}\n"


def room_lines(method: str, found: list[Row]) -> str:
    """IoU of the best single node of every room of the paper home, one line a drive."""
    text = f"\n{method}, paper home: IoU of a room's best single node, one line a drive\n"
    for row in found:
        rooms = row.metrics.rooms
        own = sum(rooms[name].best_iou >= OWN_NODE for name in OWN_ROOMS)
        values = "  ".join(f"{name} {room.best_iou:.2f}" for name, room in rooms.items())
        text += f"  {row.metrics.count:2d} regions  {values}  nodes of their own {own} of 4\n"
    return text


def summary(method: str, found: list[Row]) -> str:
    """Mean and worst of a method over all homes."""
    text = f"\n{method}, {len(found)} homes: mean / worst\n"
    for name, (get, worse) in COLUMNS.items():
        values = [get(row) for row in found]
        text += f"  {name:12s} {np.mean(values):6.3f} / {worse(values):6.3f}\n"
    convex = np.mean([row.metrics.hidden_max <= MOST_HIDDEN for row in found])
    numbers = np.mean([row.right_number for row in found])
    text += f"  every region's hidden pairs at most {MOST_HIDDEN}: {convex:.2f} of homes\n"
    return text + f"  nodes between the number of rooms and twice that: {numbers:.2f} of homes\n"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path)
    parser.add_argument("--homes", type=int, default=20)
    parser.add_argument("--first", type=int, default=1001)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--odometry", choices=("corrected", "raw"), default="corrected")
    parser.add_argument("--methods", nargs="+", choices=list(METHODS), default=list(METHODS))
    parser.add_argument("--drives", type=int, default=1)
    options = parser.parse_args()
    odometry, methods = options.odometry, options.methods
    with Pool(options.jobs) as pool:
        if options.data is None:
            names = [f"random-{options.first + i}" for i in range(options.homes)]
            drives = [(PAPER_HOME, DRIVE_SEED + i) for i in range(options.drives)]
            tasks = [
                pool.apply_async(own_home, (name, odometry, methods, seed))
                for name, seed in [*drives, *((name, DRIVE_SEED) for name in names)]
            ]
        else:
            folder = str(options.data / "homes")
            tasks = [
                pool.apply_async(shared_home, (folder, name, odometry, methods))
                for name in SHARED_HOMES
            ]
        sys.stdout.write(f"{'':24s} rooms {' '.join(f'{name:>11s}' for name in COLUMNS)}\n")
        found: list[Row] = []
        for task in tasks:
            found += task.get()
            sys.stdout.writelines(line(row) for row in found[-len(methods) - 1 :])
            sys.stdout.flush()
    for method in (*methods, UPPER):
        of_method = [row for row in found if row.method == method]
        at_paper = [row for row in of_method if row.home == PAPER_HOME]
        # Further drives through the paper home do not weigh in the mean over homes.
        sys.stdout.write(summary(method, [*at_paper[:1], *of_method[len(at_paper) :]]))
        if at_paper:
            sys.stdout.write(room_lines(method, at_paper))


if __name__ == "__main__":
    main()
