"""What a step of autonomous modelling costs: `python tests/benchmarks/autonomous_step.py`.

CPU time from the local map to the decision, at every step along a drive through the paper home, and
what a scan costs. The drive is then driven back and forth again (the same scans in reverse order), to
see whether a step gets dearer with the length of the drive.
"""

from __future__ import annotations

import argparse
import pickle
import sys
import time

import numpy as np

from core.pipeline.growing_model import METHODS, GrowingModel, MethodName
from core.sensing import RobotLog
from core.simulation import build_home, simulate

DRIVE_SEED = 1001
TARGET_MS = 50.0
WARM_SCANS = 250
"""Scans folded beforehand, for the compiled loops to be ready."""


def there_and_back(log: RobotLog, laps: int) -> np.ndarray:
    """Indices of the scans of a drive to and fro."""
    forth = np.arange(len(log))
    return np.concatenate([forth if lap % 2 == 0 else forth[::-1] for lap in range(laps)])


def folded(log: RobotLog, laps: int, method: MethodName) -> tuple[np.ndarray, np.ndarray, int]:
    """Milliseconds of each step and of each scan between, and the size of the saved state."""
    model, steps, scans = GrowingModel(log.ring, method=METHODS[method]), [], []
    for i in there_and_back(log, laps):
        start = time.process_time()
        taken = model.add(log.scan(int(i)), log.odometry[i])
        (steps if taken else scans).append(1000 * (time.process_time() - start))
    return np.array(steps), np.array(scans), len(pickle.dumps(model))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--laps", type=int, default=4)
    parser.add_argument("--method", choices=("default", "paper"), default="default")
    options = parser.parse_args()
    log = simulate(build_home("paper"), seed=DRIVE_SEED).without_truth()
    folded(log.slice(0, WARM_SCANS), 2, options.method)
    steps, scans, size = folded(log, options.laps, options.method)
    write = sys.stdout.write
    write(f"{log.distance_m:.0f} m a lap, {options.laps} laps, method {options.method}\n")
    write(
        f"a step: median {np.median(steps):.0f} ms (target {TARGET_MS:.0f}), "
        f"90 % below {np.quantile(steps, 0.9):.0f}, most {steps.max():.0f}\n"
    )
    for lap, part in enumerate(np.array_split(steps, options.laps)):
        write(f"  lap {lap + 1}: median {np.median(part):.0f} ms, mean {part.mean():.0f} ms\n")
    write(f"a scan between: median {np.median(scans):.2f} ms, mean {scans.mean():.2f} ms\n")
    write(f"saved state: {size / 1e6:.1f} MB\n")


if __name__ == "__main__":
    main()
