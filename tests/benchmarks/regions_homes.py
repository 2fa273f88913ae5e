"""Regions found on drives through homes: autonomous, and offline with the number found.

    python tests/benchmarks/regions_homes.py --data SHARED [--step 5] [HOME ...]

SHARED/homes holds `logs/HOME_map.jsonl.gz` and `truth/HOME.npz`. The map is made anew from the
scans so far at every step of the drive; odometry as it is in the log.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np

from core.evaluation.ground_truth import GroundTruth
from core.evaluation.region_metrics import region_metrics
from core.geometry import IntArray, travelled
from core.log_readers.registry import read_log
from core.mapping import GridGeometry, OccupancyGrid
from core.mapping.cemal import cemal_map
from core.segmentation.automatic import segment_automatically
from core.segmentation.autonomous import extract, finish, region_image
from core.segmentation.extraction_state import ExtractionState
from core.segmentation.moment import Moment
from core.sensing import RobotLog, Trajectory

RESOLUTION = 0.05
HOMES = ("home21", "home22", "home23", "home24")


def truth_of(path: Path) -> GroundTruth:
    """Ground truth of a home."""
    stored = np.load(path, allow_pickle=False)
    meta = json.loads(str(stored["meta"]))
    shape = stored["occupied"].shape
    geometry = GridGeometry(RESOLUTION, (*meta["origin"][:2], 0.0), (shape[0], shape[1]))
    doors = np.zeros((0, 4))
    return GroundTruth(
        geometry, stored["occupied"], stored["free"], stored["explored"],
        stored["rooms"].astype(np.int64), tuple(meta["rooms"]), doors,
    )  # fmt: skip


def autonomous(log: RobotLog, step: float) -> tuple[OccupancyGrid, ExtractionState, list[float]]:
    """Last map, regions and the seconds of every step."""
    distance = travelled(log.odometry)
    stops = [int(np.searchsorted(distance, d)) for d in np.arange(step, distance[-1], step)]
    state, seconds = ExtractionState(), []
    for stop in [*stops, len(log) - 1]:
        part = log.slice(0, stop + 1)
        result = cemal_map(part, Trajectory.from_odometry(part))
        start = time.process_time()
        moment = Moment(
            float(log.t[stop]),
            float(distance[stop]),
            log.odometry[stop],
            result.grid,
            result.confidence,
        )
        state = extract(state, moment)
        seconds.append(time.process_time() - start)
    return moment.grid, finish(state, moment), seconds


def row(name: str, grid: OccupancyGrid, regions: IntArray, truth: GroundTruth) -> str:
    """One line of the table."""
    m = region_metrics(regions, grid.geometry, truth)
    return (
        f"{name:24s} regions {m.count:2d} rooms {m.rooms_true}  purity {m.purity:.2f}  "
        f"ari {m.ari:.2f}  merged {m.merged_iou_mean:.2f}  hidden mean {m.hidden_mean:.2f} "
        f"most {m.hidden_max:.2f}  cover {m.coverage:.2f}\n"
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--step", type=float, default=5.0)
    parser.add_argument("homes", nargs="*", default=HOMES)
    options = parser.parse_args()
    for home in options.homes:
        log = read_log(options.data / "homes" / "logs" / f"{home}_map.jsonl.gz").log
        truth = truth_of(options.data / "homes" / "truth" / f"{home}.npz")
        grid, state, seconds = autonomous(log.without_truth(), options.step)
        sys.stdout.write(row(f"{home} autonomous", grid, region_image(state, grid), truth))
        found = segment_automatically(grid)
        sys.stdout.write(row(f"{home} offline", grid, found.regions, truth))
        sys.stdout.write(row(f"{home} offline, rooms", grid, found.rooms, truth))
        sys.stdout.write(f"{home}: a step takes {np.median(seconds):.2f} s (median)\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
