"""How long each stage takes on the paper's home, beside a fixed kernel so that machines compare.

    python tests/benchmarks/stages.py [--runs 3] [--fresh]

Prints medians. `--fresh` also times the very first model after an installation, when the compiled
loops are not there yet.
"""

from __future__ import annotations

import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from core.sensing import RobotLog, Trajectory

COMMAND = [sys.executable, "-c", "from app.cli import main; main()"]
KERNEL_SIZE, KERNEL_ROUNDS = 400, 12


def calibration_kernel() -> float:
    """A fixed amount of arithmetic: matrix products and a plain loop."""
    matrix = np.random.default_rng(0).random((KERNEL_SIZE, KERNEL_SIZE))
    for _ in range(KERNEL_ROUNDS):
        matrix = matrix @ matrix
        matrix /= matrix.max()
    total = 0.0
    for i in range(1_000_000):
        total += (i % 7) * 0.5
    return total + float(matrix[0, 0])


def seconds(call: Callable[[], object], runs: int) -> float:
    """Median wall time of a call."""
    taken = []
    for _ in range(runs):
        start = time.perf_counter()
        call()
        taken.append(time.perf_counter() - start)
    return statistics.median(taken)


def command(*arguments: object, cache: Path | None = None) -> None:
    """Runs the command line in a process of its own."""
    environment = os.environ | ({"NUMBA_CACHE_DIR": str(cache)} if cache else {})
    subprocess.run(
        [*COMMAND, *map(str, arguments)], check=True, env=environment, stdout=subprocess.DEVNULL
    )


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--fresh", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        log = work / "paper.jsonl.gz"
        command("simulate", "paper", "--out", log)
        print(f"{'stage':<46}{'median s':>9}")
        for stage, taken in stages(log, work, options.runs, options.fresh):
            print(f"{stage:<46}{taken:>9.2f}")
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{'largest process, MB':<46}{peak:>9.0f}")


def milliseconds_a_key_scan(drive: RobotLog, trajectory: Trajectory) -> float:
    """Mean processor time that a live map takes for a scan, over a whole drive."""
    from core.mapping.incremental_cemal import IncrementalCemal
    from core.pipeline.growing_map import key_scans

    growing, keys = IncrementalCemal(drive.ring), key_scans(trajectory)
    start = time.process_time()
    for scan, pose in zip(drive.taken(keys), trajectory.poses[keys], strict=True):
        growing.add(scan, pose)
    return (time.process_time() - start) / len(keys) * 1e3


def stages(log: Path, work: Path, runs: int, fresh: bool) -> list[tuple[str, float]]:
    """Each stage and its median time in seconds."""
    from core.log_readers import read_log
    from core.pipeline.mapper import map_log
    from core.pipeline.modeller import ModellingOptions, model_log
    from core.segmentation.connected import largest_component
    from core.segmentation.offline import segment_offline
    from core.topology.topology_of import topology_of

    drive = read_log(log).log
    trajectory = Trajectory.from_odometry(drive)
    echoes = int(np.isfinite(drive.ranges).sum())
    result = map_log(drive, trajectory)
    floor = largest_component(result.grid.free)
    regions = segment_offline(floor, 10)
    model_log(drive, ModellingOptions(regions=10, odometry="raw"))
    rows = [("calibration kernel", seconds(calibration_kernel, runs))]
    rows.append(("read the log", seconds(lambda: read_log(log), runs)))
    mapping = seconds(lambda: map_log(drive, trajectory), runs)
    rows.append((f"map, CEMAL, {echoes} echoes", mapping))
    rows.append(("  readings per second / 1000", drive.ranges.size / mapping / 1000))
    growing = milliseconds_a_key_scan(drive, trajectory)
    rows.append(("CEMAL scan by scan, CPU ms a key scan", growing))
    rows.append(("cut into 10 regions", seconds(lambda: segment_offline(floor, 10), runs)))
    rows.append(("topology", seconds(lambda: topology_of(result.grid, regions), runs)))
    rows.append(("echorooms --help", seconds(lambda: command("--help"), runs)))
    raw = ("--odometry", "raw")
    plain = ("map", log, "--out", work / "m", *raw)
    rows.append(("echorooms map --odometry raw", seconds(lambda: command(*plain), runs)))
    ten = ("model", log, "--regions", 10, "--out", work / "model", *raw)
    rows.append(
        ("echorooms model --regions 10 --odometry raw", seconds(lambda: command(*ten), runs))
    )
    full = ("model", log, "--out", work / "full")
    rows.append(("echorooms model, all defaults", seconds(lambda: command(*full), 1)))
    if fresh:
        first = seconds(lambda: command(*ten, cache=work / "cache"), 1)
        rows.append(("echorooms model, first after installation", first))
    return rows


if __name__ == "__main__":
    main()
