"""Localization over simulated homes that no parameter was chosen on: `python THIS [--homes N]`.

Prints one row per method and kind of drive: right node on all steps and after the fifth, drives
certain and right within 7.5 m, false certainty, expected calibration error, median position error,
metres until right again after a kidnap, milliseconds per step.
"""

from __future__ import annotations

import argparse
import time

import numpy as np

from core.evaluation.localization import (
    StepOutcome,
    aligned_truth,
    converged_after,
    outcomes,
    summary,
)
from core.pipeline.localizer import LocalizationOptions, Localizer
from core.pipeline.modeller import ModellingOptions, model_log
from core.sensing import RING_PRESETS, RobotLog
from core.simulation import simulate
from core.topology import Model

FIRST_REPORTING_SEED = 1000
RINGS = ("paper-12", "circle-16", "circle-8", "p3dx-16")
CONVERGED_M = 7.5
METHODS = {
    "default": LocalizationOptions(),
    "paper": LocalizationOptions("paper"),
    "mcl 3000": LocalizationOptions("mcl", particles=3000),
    "mcl 10000": LocalizationOptions("mcl"),
}
Drives = dict[str, list[list[StepOutcome]]]


def drives_of(home: str, ring: str, seed: int) -> tuple[Model, RobotLog, dict[str, RobotLog]]:
    """A model of a home and drives through it."""
    sonars = RING_PRESETS[ring]
    mapping = simulate(home, seed=seed, tour="mapping", ring=sonars)
    model = model_log(mapping.without_truth(), ModellingOptions(mode="offline", regions=10))

    def drive(number: int, odometry: str = "calibrated", **what: bool) -> RobotLog:
        return simulate(
            home, seed=10 * seed + number, tour="localization", ring=sonars, odometry=odometry, **what
        )  # fmt: skip

    logs = {"static 1": drive(1), "static 2": drive(2), "changed": drive(3, changed=True)}
    logs |= {"bad odometry": drive(4, "bad"), "kidnap": drive(5, kidnap=True)}
    return model, mapping, logs


def kidnap_time(log: RobotLog) -> float:
    """When the robot was carried: the longest hop of the true path."""
    assert log.truth is not None
    hops = np.hypot(*np.diff(log.truth[:, :2], axis=0).T)
    return float(log.t[int(hops.argmax()) + 1])


def run(
    model: Model, log: RobotLog, truth: np.ndarray, options: LocalizationOptions
) -> tuple[list[StepOutcome], list[float]]:
    """The scored steps of one drive and the seconds each took."""
    localizer = Localizer(model, log.ring, options)
    state, steps, seconds = localizer.start(), [], []
    for scan in log.without_truth():
        start = time.perf_counter()
        state, step = localizer.advance(state, scan)
        if step is not None:
            steps.append(step)
            seconds.append(time.perf_counter() - start)
    return outcomes(steps, model, log.t, truth), seconds


def row(name: str, kind: str, drives: list[list[StepOutcome]], extra: str) -> str:
    score = summary(drives)
    soon = np.mean([converged_after(drive) <= CONVERGED_M for drive in drives])
    return (
        f"{name:10s} {kind:13s} n {len(drives):3d}  all {score.accuracy:.3f}  late {score.late:.3f}  "
        f"<= {CONVERGED_M} m {soon:.2f}  false {score.false_certain:.3f}  "
        f"ECE {score.calibration_error:.3f}  error {score.position_error:.2f} m{extra}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--homes", type=int, default=10)
    parser.add_argument("--methods", default=",".join(METHODS))
    arguments = parser.parse_args()
    methods = arguments.methods.split(",")
    found: dict[str, Drives] = {name: {} for name in methods}
    recovered: dict[str, list[float]] = {name: [] for name in methods}
    times: dict[str, list[float]] = {name: [] for name in methods}
    for number in range(arguments.homes):
        seed = FIRST_REPORTING_SEED + number
        model, mapping, logs = drives_of(f"random-{seed}", RINGS[number % len(RINGS)], seed)
        for kind, log in logs.items():
            truth = aligned_truth(log, mapping)
            for name in methods:
                drive, seconds = run(model, log, truth, METHODS[name])
                found[name].setdefault(kind.rstrip(" 12"), []).append(drive)
                times[name] += seconds[1:]
                if kind == "kidnap":
                    recovered[name].append(converged_after(drive, kidnap_time(log)))
        print(f"after {number + 1} homes", flush=True)
        print_table(found, recovered, times)


def print_table(
    found: dict[str, Drives], recovered: dict[str, list[float]], times: dict[str, list[float]]
) -> None:
    for name, kinds in found.items():
        for kind, drives in kinds.items():
            again = np.sort(recovered[name]).round(1).tolist()
            extra = f"  right again after {again} m" if kind == "kidnap" else ""
            print(row(name, kind, drives, extra))
        print(f"{name:10s} {np.median(times[name]) * 1e3:.0f} ms a step (median)", flush=True)


if __name__ == "__main__":
    main()
