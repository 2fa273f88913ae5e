"""Drift correction on generated homes and special worlds: errors before and after.

    python tests/benchmarks/drift_generated.py [--first 101] [--homes 20] [--odometry bad] [--worlds]

Errors are in metres against the true poses along the drive (mean) and at its end, headings in degrees.
`--worlds` adds the mirrored home, the long corridor, the empty hall, a robot that spins on the spot, a
jump of the odometry and a kidnapped robot.
"""

from __future__ import annotations

import argparse
import math
import sys
import time

import numpy as np

from core.geometry import compose, inverse, wrap_angle
from core.pipeline.odometry import OdometryResult, trajectory_for
from core.sensing import RobotLog
from core.simulation import simulate


def errors(poses: np.ndarray, log: RobotLog, part: tuple[int, int]) -> tuple[float, float, float]:
    """Mean and final position error (m), largest heading error (degrees) over a part of the drive."""
    assert log.truth is not None
    span = slice(*part)
    start = part[0]
    truth = compose(log.odometry[start], compose(inverse(log.truth[start]), log.truth[span]))
    off = np.hypot(*(poses[span, :2] - truth[:, :2]).T)
    turned = np.abs(wrap_angle(poses[span, 2] - truth[:, 2]))
    return float(off.mean()), float(off[-1]), math.degrees(float(turned.max()))


def row(name: str, log: RobotLog) -> tuple[OdometryResult, np.ndarray]:
    """Corrects one drive and prints its line; the six errors."""
    start = time.process_time()
    result = trajectory_for(log)
    seconds = time.process_time() - start
    before = errors(log.odometry, log, result.part)
    after = errors(result.trajectory.poses, log, result.part)
    closures = sum(closure.accepted for closure in result.closures)
    sys.stdout.write(
        f"{name:<14}{log.distance_m:6.0f} m  {before[0]:6.2f} {after[0]:6.3f}  {before[1]:6.2f} "
        f"{after[1]:6.3f}  {before[2]:6.1f} {after[2]:5.1f}  {result.used:<10}{closures:4d}  {seconds:5.1f}\n"
    )
    sys.stdout.flush()
    return result, np.array([*before, *after])


def main() -> None:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--first", type=int, default=101)
    parser.add_argument("--homes", type=int, default=20)
    parser.add_argument("--odometry", default="bad")
    parser.add_argument("--worlds", action="store_true")
    chosen = parser.parse_args()
    sys.stdout.write(
        "home            drive  mean: raw, now   end: raw, now  heading: raw, now   used  closures  cpu s\n"
    )
    table = []
    for number in range(chosen.first, chosen.first + chosen.homes):
        log = simulate(f"random-{number}", seed=number, odometry=chosen.odometry)
        table.append(row(f"random-{number}", log)[1])
    if table:
        all_rows = np.array(table)
        with np.errstate(divide="ignore", invalid="ignore"):
            cut = np.nanmedian(all_rows[:, 1] / all_rows[:, 4])
        worse = int((all_rows[:, 3] > all_rows[:, 0] + 0.005).sum())
        sys.stdout.write(
            f"median mean error {np.median(all_rows[:, 0]):.3f} -> {np.median(all_rows[:, 3]):.3f}, "
            f"end error cut by {cut:.1f} in the median, {worse} worse than raw\n"
        )
    if chosen.worlds:
        for name, arguments in (
            ("mirrored", {}),
            ("corridor", {}),
            ("hall", {}),
            ("office", {}),
            ("paper", {"tour": "spin"}),
            ("paper", {"jump": 1.0}),
            ("paper", {"kidnap": True}),
        ):
            log = simulate(name, seed=1, odometry="bad", **arguments)  # type: ignore[arg-type]
            label = " ".join([name, *(f"{key}" for key in arguments)])
            result, _ = row(label, log)
            sys.stdout.write("".join(f"    {sentence}\n" for sentence in result.sentences))


if __name__ == "__main__":
    main()
