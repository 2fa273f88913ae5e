"""A drive through a modelled home, localized by several methods and judged."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from app.reproduction.extent import Extent
from core.evaluation.localization import (
    LocalizationScore,
    StepOutcome,
    aligned_truth,
    outcomes,
    summary,
)
from core.geometry import FloatArray
from core.localization.localization_step import LocalizationStep
from core.pipeline.localizer import LocalizationOptions, localize_log
from core.progress import Progress, part_of
from core.sensing import RobotLog
from core.simulation import simulate
from core.topology import Model


@dataclass(frozen=True)
class LocalizedDrive:
    """A drive and what each method said.

    Attributes:
        seed: of the drive.
        changed: whether the home had changed since it was mapped.
        log: the drive.
        truth: (N, 3) its true poses in the model's frame.
        steps, judged: by method; judged leaves out steps outside all regions.
    """

    seed: int
    changed: bool
    log: RobotLog
    truth: FloatArray
    steps: Mapping[str, tuple[LocalizationStep, ...]]
    judged: Mapping[str, tuple[StepOutcome, ...]]

    def score(self, method: str) -> LocalizationScore:
        """The figures of one method."""
        return summary([self.judged[method]])


def localized_drive(
    home: str,
    model: Model,
    mapping: RobotLog,
    seed: int,
    changed: bool,
    extent: Extent,
    progress: Progress,
) -> LocalizedDrive:
    """Drives through a home and localizes the robot in a model of it, start unknown.

    Args:
        home: its name.
        model: of the home.
        mapping: the drive that the model was made of, with truth.
        seed: of the drive.
        changed: a seat gone, a chair gone or pushed, a door shut.
        extent: methods and their parameters.
        progress: told all along.
    """
    log = simulate(home, seed=seed, tour="localization", changed=changed)
    if model.trajectory is not None:
        mapping = replace(mapping, odometry=model.trajectory.poses)
    truth = aligned_truth(log, mapping)
    steps: dict[str, tuple[LocalizationStep, ...]] = {}
    judged: dict[str, tuple[StepOutcome, ...]] = {}
    for i, method in enumerate(extent.methods):
        options = LocalizationOptions(method, extent.step, extent.particles, extent.seed)
        rest = part_of(progress, i / len(extent.methods), (i + 1) / len(extent.methods))
        steps[method] = tuple(localize_log(model, log, options, rest))
        judged[method] = tuple(outcomes(steps[method], model, log.t, truth))
    return LocalizedDrive(seed, changed, log, truth, steps, judged)
