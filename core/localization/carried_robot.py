"""A robot that is carried in the middle of a step: its readings come from two places.

No pose explains them all, and the older ones can hold the belief where the robot no longer is. So
when the newest readings contradict the most probable place, two accounts are compared: the robot is
there in spite of them, or it was carried and is anywhere.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray
from core.localization.pose_grid import PoseBelief
from core.localization.pose_observation import ScoreArray

LEAST = 1e-12
"""Mass that is never divided by less."""


@dataclass(frozen=True)
class CarriedConfig:
    """When a robot may have been carried in the middle of a step. Chosen on simulated homes.

    Attributes:
        newest: share of a step's readings that are looked at alone.
        explained: share of their echoes that the most probable place explains at least; right
            places explained .55 or more of them, wrong ones after a kidnap .1-.4.
        suspicion: chance of having been carried when they explain less.
    """

    newest: float = 1 / 3
    explained: float = 0.5
    suspicion: float = 0.1


def chance_carried(
    belief: PoseBelief, anywhere: PoseBelief, score: ScoreArray, temper: float, suspicion: float
) -> float:
    """Probability that the newest readings are those of a robot that was carried.

    Args:
        belief: after all readings of the step.
        anywhere: where a carried robot may be.
        score: log-likelihood ratio of the newest readings at every pose (headings, rows, cols).
        temper: exponent of the likelihood.
        suspicion: chance of being carried, given that the newest readings contradict the belief.
    """
    best = float(score.max(initial=-np.inf))
    if not math.isfinite(best):
        return 0.0
    likelihood = np.exp(temper * (score - best), dtype=np.float64)
    carried = suspicion * _mean(anywhere, likelihood)
    stayed = (1 - suspicion) * _mean(belief, likelihood)
    return carried / (carried + stayed) if carried > 0 else 0.0


def mixed(one: PoseBelief, other: PoseBelief, share: float) -> PoseBelief:
    """One belief with a share of another."""
    mass = (1 - share) * one.mass + share * other.mass
    return PoseBelief(mass.astype(np.float32), (1 - share) * one.unknown + share * other.unknown)


def _mean(belief: PoseBelief, likelihood: FloatArray) -> float:
    """Mean likelihood of the poses of a belief."""
    mapped = max(float(belief.mass.sum(dtype=np.float64)), LEAST)
    return float((belief.mass * likelihood).sum()) / mapped
