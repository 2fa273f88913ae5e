"""Localization over simulated homes that no parameter was chosen on: `python THIS [--homes N]`.

Every home is modelled as the product does it by default: autonomous, corrected odometry (calibrated
mapping drive). Truth is brought into the model's frame by one rigid fit of the mapping drive.
`--first` below 1000 gives homes for choosing parameters.

Prints, by method and kind of drive: right node on all steps and after the fifth, drives certain and
right within 7.5 m, false certainty, expected calibration error, median position error; how far a
kidnapped robot drove until it was right again; the reliability diagram; CPU milliseconds an update.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from core.evaluation.localization import (
    StepOutcome,
    aligned_truth,
    converged_after,
    driven_metres,
    outcomes,
    reliability,
    summary,
)
from core.pipeline.localizer import LocalizationOptions, Localizer
from core.pipeline.modeller import model_log
from core.sensing import RING_PRESETS, RobotLog
from core.simulation import simulate
from core.simulation.sonar_model import NOISY
from core.topology import Model

FIRST_REPORTING_SEED = 1000
RINGS = ("paper-12", "circle-16", "circle-8", "p3dx-16")
CONVERGED_M = 7.5
SURE = 0.9
METHODS = {
    "default": LocalizationOptions(),
    "paper": LocalizationOptions("paper"),
    "mcl 3000": LocalizationOptions("mcl", particles=3000),
    "mcl 10000": LocalizationOptions("mcl"),
}
ORDINARY = (
    "static",
    "static",
    "changed",
    "changed",
    "bad odometry",
    "noisy sonar",
    "kidnap",
    "kidnap",
)
MIRRORED = ("mirrored",) * 5


@dataclass(frozen=True)
class Found:
    """What one method said on one drive: kind, scored steps, seconds an update, and where the robot
    was carried (time and metres), if it was."""

    method: str
    kind: str
    steps: list[StepOutcome]
    seconds: list[float]
    carried: tuple[float, float] | None


@dataclass(frozen=True)
class Job:
    """A home to map, and the drives through it."""

    home: str
    ring: str
    seed: int
    kinds: tuple[str, ...]
    methods: tuple[str, ...]


def localized(job: Job) -> list[Found]:
    """Maps a home and localizes all drives by all methods."""
    sonars = RING_PRESETS[job.ring]
    mapping = simulate(job.home, seed=job.seed, tour="mapping", ring=sonars)
    model = model_log(mapping.without_truth())
    assert model.trajectory is not None
    mapping = replace(mapping, odometry=model.trajectory.poses)
    found = []
    for number, kind in enumerate(job.kinds, 1):
        log = simulate(
            job.home,
            seed=10 * job.seed + number,
            tour="localization",
            ring=sonars,
            odometry="bad" if kind == "bad odometry" else "calibrated",
            sonar=NOISY if kind == "noisy sonar" else None,
            changed=kind == "changed",
            kidnap=kind == "kidnap",
        )
        truth = aligned_truth(log, mapping)
        carried = carried_at(log) if kind == "kidnap" else None
        for name in job.methods:
            steps, seconds = run(model, log, truth, METHODS[name])
            found.append(Found(name, kind, steps, seconds, carried))
    return found


def run(
    model: Model, log: RobotLog, truth: np.ndarray, options: LocalizationOptions
) -> tuple[list[StepOutcome], list[float]]:
    """The scored steps of one drive, and CPU seconds of each update after the first."""
    localizer = Localizer(model, log.ring, options)
    state, steps, seconds = localizer.start(), [], []
    for scan in log.without_truth():
        start = time.process_time()
        state, step = localizer.advance(state, scan)
        if step is not None:
            steps.append(step)
            seconds.append(time.process_time() - start)
    return outcomes(steps, model, log.t, truth), seconds[1:]


def carried_at(log: RobotLog) -> tuple[float, float]:
    """When the robot was carried (the longest hop of the true path), and metres driven by then."""
    assert log.truth is not None
    hops = np.hypot(*np.diff(log.truth[:, :2], axis=0).T)
    after = int(hops.argmax()) + 1
    return float(log.t[after]), float(driven_metres(log.truth)[after])


def jobs(arguments: argparse.Namespace) -> Iterator[Job]:
    """All methods on the first homes, the default on all."""
    methods = tuple(arguments.methods.split(","))

    def asked(number: int, peers: int) -> tuple[str, ...]:
        return methods if number < peers else methods[:1]

    for number in range(arguments.homes):
        seed, ring = arguments.first + number, RINGS[number % len(RINGS)]
        yield Job(f"random-{seed}", ring, seed, ORDINARY, asked(number, arguments.peers))
    for number in range(arguments.mirrored):
        seed, ring = arguments.first + number, RINGS[number % len(RINGS)]
        yield Job("mirrored", ring, seed, MIRRORED, asked(number, arguments.peers))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--homes", type=int, default=12)
    parser.add_argument("--mirrored", type=int, default=4, help="mapping drives of that home")
    parser.add_argument("--methods", default=",".join(METHODS))
    parser.add_argument("--peers", type=int, default=4, help="homes for all but the first method")
    parser.add_argument("--first", type=int, default=FIRST_REPORTING_SEED, help="first seed")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    found: list[Found] = []
    with ProcessPoolExecutor(arguments.jobs) as pool:
        for number, of_home in enumerate(pool.map(localized, jobs(arguments)), 1):
            found += of_home
            print(f"after {number} models:")
            print_tables(found, arguments.methods.split(","))


def print_tables(found: list[Found], methods: list[str]) -> None:
    """The tables of all methods; the reliability diagram of the first one."""
    for name in methods:
        own = [f for f in found if f.method == name]
        if not own:
            continue
        for kind in dict.fromkeys(f.kind for f in own):
            print(row(name, kind, [f for f in own if f.kind == kind]))
        ordinary = [f for f in own if f.kind != "mirrored"]
        if ordinary:
            print(row(name, "all ordinary", ordinary))
        carried = [f for f in own if f.carried]
        metres = np.sort([converged_after(f.steps, *f.carried) for f in carried if f.carried])
        after = [s for f in carried if f.carried for s in f.steps if s.t >= f.carried[0]]
        if after:
            print(f"{name}: right again after {metres.round(1).tolist()} m")
            false = np.mean([s.probability > SURE and not s.right for s in after])
            right = np.mean([s.right for s in after])
            print(f"{name}: after the kidnap right {right:.3f}, certain and wrong {false:.3f}")
        seconds = [s for f in own for s in f.seconds]
        print(f"{name}: {np.median(seconds) * 1e3:.0f} ms CPU an update (median)", flush=True)
    print_reliability([s for f in found if f.method == methods[0] for s in f.steps])


def row(name: str, kind: str, found: list[Found]) -> str:
    """One line of the table."""
    drives = [f.steps for f in found if f.steps]
    score = summary(drives)
    soon = np.mean([converged_after(drive) <= CONVERGED_M for drive in drives])
    worst = min((summary([drive]).accuracy for drive in drives), default=np.nan)
    return (
        f"{name:10s} {kind:13s} n {len(drives):3d} steps {score.steps:4d}  "
        f"all {score.accuracy:.3f} (worst {worst:.2f})  "
        f"late {score.late:.3f}  <= {CONVERGED_M} m {soon:.2f}  false {score.false_certain:.3f}  "
        f"ECE {score.calibration_error:.3f}  error {score.position_error:.2f} m"
    )


def print_reliability(steps: list[StepOutcome]) -> None:
    """Rows of the reliability diagram, mirrored homes among them."""
    told = np.array([s.probability for s in steps])
    print("probability told, share right, steps:")
    for mean, right, count in reliability(told, np.array([s.right for s in steps])):
        if count:
            print(f"  {mean:.2f}  {right:.2f}  {count:.0f}")


if __name__ == "__main__":
    main()
