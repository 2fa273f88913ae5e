"""The localizer: state + scan -> state, and a step every few metres (paper, Fig. 6).

A batch is a fold over the scans of a log; a live session feeds the same function scan by scan. The
state holds only values, so it can be kept, copied and resumed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal, Protocol

import numpy as np

from core.errors import InputError
from core.localization.localization_step import LocalizationStep
from core.localization.monte_carlo import MonteCarloConfig, MonteCarloLocalizer
from core.localization.paper_localizer import PaperLocalizer
from core.localization.pose_grid_localizer import PoseGridLocalizer
from core.progress import Progress, no_progress
from core.sensing import RobotLog, Scan, SonarRing
from core.topology import Model

LocalizationMethod = Literal["default", "paper", "mcl"]
STEP_DISTANCE = 2.5
"""Metres of travel between two time steps."""
SHORTEST_STEP, LONGEST_STEP = 0.2, 50.0
LAST_STEP_SHARE = 0.2
"""A drive's rest that is shorter than this share of a step is no step of its own."""


@dataclass(frozen=True)
class LocalizationOptions:
    """What a user chooses: method, metres per time step, seed of the particles."""

    method: LocalizationMethod = "default"
    step: float = STEP_DISTANCE
    particles: int = 10_000
    seed: int = 0

    def __post_init__(self) -> None:
        if self.method not in ("default", "paper", "mcl"):
            raise InputError(f"localization method {self.method!r}: choose default, paper or mcl")
        if not SHORTEST_STEP <= self.step <= LONGEST_STEP:
            raise InputError(
                f"a step of {self.step:g} m: choose from {SHORTEST_STEP} to {LONGEST_STEP} m"
            )
        if not 1 <= self.particles <= 1_000_000:
            raise InputError(f"{self.particles} particles: choose from 1 to 1000000")


class StepMethod(Protocol):
    """A localization method: a belief, and what the scans of a time step do to it."""

    def start(self) -> Any:
        """The belief before anything is known."""

    def advance(self, state: Any, part: RobotLog) -> tuple[Any, LocalizationStep]:
        """The belief after a step whose scans are `part`; its first is the last step's last."""


@dataclass(frozen=True)
class LocalizerState:
    """Between two scans.

    Attributes:
        belief: of the method.
        scans: those since the last step, from its last one on.
        driven: metres since the last step.
        steps: how many there were.
    """

    belief: Any
    scans: tuple[Scan, ...] = ()
    driven: float = 0.0
    steps: int = 0


class Localizer:
    """Finds a robot with a given sonar ring in a modelled home."""

    def __init__(
        self, model: Model, ring: SonarRing, options: LocalizationOptions | None = None
    ) -> None:
        self.ring = ring
        self.options = options or LocalizationOptions()
        self.method = _method(model, ring, self.options)

    def start(self) -> LocalizerState:
        """Nothing known, nothing driven."""
        return LocalizerState(self.method.start())

    def advance(
        self, state: LocalizerState, scan: Scan
    ) -> tuple[LocalizerState, LocalizationStep | None]:
        """One scan more, and the step that it completes, if it does."""
        driven = state.driven
        if state.scans:
            hop = scan.odometry[:2] - state.scans[-1].odometry[:2]
            driven += float(np.hypot(*hop))
        state = replace(state, scans=(*state.scans, scan), driven=driven)
        if driven < self.options.step:
            return state, None
        return self._complete(state)

    def finish(self, state: LocalizerState) -> tuple[LocalizerState, LocalizationStep | None]:
        """The end of a drive: its rest as a last step, if that is worth one."""
        rest = state.driven >= LAST_STEP_SHARE * self.options.step
        if state.scans and (rest or state.steps == 0):
            return self._complete(state)
        return state, None

    def _complete(self, state: LocalizerState) -> tuple[LocalizerState, LocalizationStep]:
        part = _log_of(state.scans, self.ring)
        belief, step = self.method.advance(state.belief, part)
        return LocalizerState(belief, state.scans[-1:], 0.0, state.steps + 1), step


def localize_log(
    model: Model,
    log: RobotLog,
    options: LocalizationOptions | None = None,
    progress: Progress = no_progress,
) -> Iterator[LocalizationStep]:
    """The steps of a drive, one by one as they are found.

    Raises:
        InputError: the log holds no scan.
        ModelError: the model has no nodes to be in.
    """
    if len(log) == 0:
        raise InputError(f"log {log.name!r} holds no scan")
    progress(0.0, "reading the map")
    localizer = Localizer(model, log.ring, options)
    state = localizer.start()
    for i, scan in enumerate(log.without_truth()):
        state, step = localizer.advance(state, scan)
        if step is not None:
            progress((i + 1) / len(log), "localizing")
            yield step
    state, step = localizer.finish(state)
    if step is not None:
        yield step
    progress(1.0, "localizing")


def _log_of(scans: tuple[Scan, ...], ring: SonarRing) -> RobotLog:
    return RobotLog(
        "step",
        ring,
        np.array([s.t for s in scans]),
        np.array([s.odometry for s in scans]).reshape(-1, 3),
        np.array([s.ranges for s in scans]).reshape(len(scans), len(ring)),
        np.array([s.fresh for s in scans], bool).reshape(len(scans), len(ring)),
    )


def _method(model: Model, ring: SonarRing, options: LocalizationOptions) -> StepMethod:
    if options.method == "paper":
        return PaperLocalizer(model)
    if options.method == "mcl":
        config = MonteCarloConfig(particles=options.particles)
        return MonteCarloLocalizer(model, ring, config, options.seed)
    return PoseGridLocalizer(model, ring)
