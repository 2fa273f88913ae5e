"""How good a localization is: right nodes, convergence, false certainty, calibration, recovery.

The true node of a step is the region of the model under the true pose at the step's time; where the
pixel has none, the nearest region within half a metre; steps with none are not scored. True poses
are first brought into the model's frame by one rigid fit (`aligned_truth`), so that what is judged is
the localization and not how far the mapping drive had drifted as a whole.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.geometry import FloatArray, compose, rigid_fit
from core.localization.localization_step import LocalizationStep
from core.sensing import RobotLog
from core.topology import Model

SURE = 0.9
"""Probability from which on a localization counts as certain."""
NEAR = 0.5
"""Metres within which a place without a region belongs to the nearest one."""
EARLY_STEPS = 5
"""Steps that a global start is given before "late" figures count."""
BINS = 10
"""Bins of the reliability diagram."""
CARRIED = 1.0
"""Metres between two scans from which on the robot was carried, not driven."""


@dataclass(frozen=True)
class StepOutcome:
    """One scored step: metres driven, right or not, probability told, of the truth, of `unknown`,
    and the distance of the best node's candidate from the true position (m)."""

    t: float
    metres: float
    right: bool
    probability: float
    true_probability: float
    unknown: float
    error: float


@dataclass(frozen=True)
class LocalizationScore:
    """Figures of one or more drives.

    Attributes:
        accuracy: share of steps whose best node is right; late: after the fifth.
        converged: share of drives that were ever certain and right; converged_m: median metres until
            then (inf when fewer than half are).
        false_certain: share of steps that are certain and wrong.
        calibration_error: expected calibration error of the best node's probability.
        position_error: median distance after step 5, metres.
    """

    steps: int
    accuracy: float
    late: float
    converged: float
    converged_m: float
    false_certain: float
    calibration_error: float
    position_error: float


def aligned_truth(log: RobotLog, mapping: RobotLog) -> FloatArray:
    """True poses (N, 3) of a drive in the frame of the map that a mapping drive made.

    Both logs need truth; the map lies in the mapping drive's odometry frame.
    """
    if log.truth is None or mapping.truth is None:
        raise ValueError("truth is needed to score a localization")
    frame = rigid_fit(mapping.odometry[:, :2], mapping.truth[:, :2])
    return compose(frame, log.truth)


def outcomes(
    steps: Sequence[LocalizationStep], model: Model, t: FloatArray, truth: FloatArray
) -> list[StepOutcome]:
    """The scored steps of one drive.

    Args:
        steps: what the localization said.
        model: the model it was said about.
        t, truth: times (N,) and true poses (N, 3) in the model's frame.
    """
    node_at = _true_nodes(model, truth[:, :2])
    driven = driven_metres(truth)
    found = []
    for step in steps:
        k = int(np.abs(t - step.t).argmin())
        node = node_at[k]
        if node is None:
            continue
        candidate = step.candidates.get(step.best)
        error = float(np.hypot(*(candidate.pose[:2] - truth[k, :2]))) if candidate else np.nan
        found.append(
            StepOutcome(
                step.t,
                float(driven[k]),
                step.best == node,
                step.probabilities[step.best],
                step.probabilities.get(node, 0.0),
                step.unknown,
                error,
            )
        )
    return found


def summary(drives: Sequence[Sequence[StepOutcome]]) -> LocalizationScore:
    """The figures of some drives together."""
    steps = [step for drive in drives for step in drive]
    if not steps:
        return LocalizationScore(0, 0.0, 0.0, 0.0, np.inf, 0.0, 0.0, np.nan)
    late = [step for drive in drives for step in drive[EARLY_STEPS:]] or steps
    right = np.array([s.right for s in steps])
    sure = np.array([s.probability > SURE for s in steps])
    metres = np.array([converged_after(drive) for drive in drives])
    return LocalizationScore(
        len(steps),
        float(right.mean()),
        float(np.mean([s.right for s in late])),
        float(np.isfinite(metres).mean()),
        float(np.median(metres)),
        float((sure & ~right).mean()),
        calibration_error(np.array([s.probability for s in steps]), right),
        float(np.nanmedian([s.error for s in late])),
    )


def driven_metres(truth: FloatArray) -> FloatArray:
    """Metres driven until each true pose (N, 3); being carried is no driving."""
    hops = np.hypot(*np.diff(truth[:, :2], axis=0).T)
    return np.append(0.0, np.cumsum(np.where(hops < CARRIED, hops, 0.0)))


def converged_after(
    drive: Sequence[StepOutcome], since: float = -np.inf, start: float = 0.0
) -> float:
    """Metres driven until a step is certain and right; inf = never.

    Args:
        drive: the scored steps.
        since: time from which on steps count.
        start: metres driven until then.
    """
    good = (s for s in drive if s.t >= since and s.right and s.probability > SURE)
    return next((s.metres - start for s in good), np.inf)


def reliability(probabilities: FloatArray, right: FloatArray) -> FloatArray:
    """The reliability diagram: (BINS, 3) of mean probability, share right, number of steps."""
    index = np.minimum((np.asarray(probabilities) * BINS).astype(int), BINS - 1)
    rows = np.full((BINS, 3), np.nan)
    rows[:, 2] = np.bincount(index, minlength=BINS)
    for b in range(BINS):
        inside = index == b
        if inside.any():
            rows[b, :2] = np.mean(probabilities[inside]), np.mean(right[inside])
    return rows


def calibration_error(probabilities: FloatArray, right: FloatArray) -> float:
    """Expected calibration error: mean distance of probability and share right, by bin."""
    rows = reliability(probabilities, right)
    filled = rows[rows[:, 2] > 0]
    if len(filled) == 0:
        return 0.0
    return float((np.abs(filled[:, 0] - filled[:, 1]) * filled[:, 2]).sum() / filled[:, 2].sum())


def _true_nodes(model: Model, points: FloatArray) -> list[str | None]:
    """The node at each world point (N, 2)."""
    names = {node.region: node.id for node in model.topology.nodes}
    geometry = model.grid.geometry
    pad = round(2 * NEAR / geometry.resolution)
    labels = np.pad(np.where(np.isin(model.regions, list(names)), model.regions, 0), pad)
    away, nearest = ndimage.distance_transform_edt(labels == 0, return_indices=True)
    cells = np.clip(geometry.cell_of(points) + pad, 0, np.array(labels.shape) - 1)
    rows, cols = cells.T
    region = labels[nearest[0][rows, cols], nearest[1][rows, cols]]
    close = away[rows, cols] * geometry.resolution <= NEAR
    return [names.get(int(r)) if ok else None for r, ok in zip(region, close, strict=True)]
