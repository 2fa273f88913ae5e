"""What a localization says at one time step, whichever method said it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from core.geometry import FloatArray

ROUNDING = 4
"""Decimals of metres and radians in what is written."""
PROBABILITY_ROUNDING = 6


@dataclass(frozen=True)
class Candidate:
    """The best place of one node for the readings of a step.

    Attributes:
        pose: (3,) of the robot at the time of the step, in the map's frame.
        score: how well the readings fit there, 0..1 (what exactly is the method's own).
    """

    pose: FloatArray
    score: float


@dataclass(frozen=True)
class LocalizationStep:
    """The belief at time `t`; all poses are where the robot is at `t`.

    Attributes:
        step: 1 for the first.
        t: seconds, time of the last scan used.
        probabilities: node id -> probability; with `unknown` they sum to 1.
        unknown: probability that the robot is nowhere in the map.
        best: the most probable node.
        pose: (3,) the most probable pose.
        entropy: eq. (21), 0..1.
        updated: whether the readings of this step changed the belief.
        candidates: node id -> the best place in it.
        template: (K, 2) points of the local map in the robot's frame at `t`.
        why: one sentence for people.
    """

    step: int
    t: float
    probabilities: Mapping[str, float]
    unknown: float
    best: str
    pose: FloatArray
    entropy: float
    updated: bool
    candidates: Mapping[str, Candidate]
    template: FloatArray
    why: str

    def as_dict(self) -> dict[str, Any]:
        """The step as it is written to a line of `STEPS.jsonl`."""
        return {
            "step": self.step,
            "t": round(self.t, ROUNDING),
            "probabilities": {
                k: round(p, PROBABILITY_ROUNDING) for k, p in self.probabilities.items()
            },
            "unknown": round(self.unknown, PROBABILITY_ROUNDING),
            "best": self.best,
            "pose": _rounded(self.pose),
            "entropy": round(self.entropy, PROBABILITY_ROUNDING),
            "updated": self.updated,
            "candidates": {
                k: [*_rounded(c.pose[:2]), round(c.score, ROUNDING)]
                for k, c in self.candidates.items()
            },
            "candidate_headings": {
                k: round(float(c.pose[2]), ROUNDING) for k, c in self.candidates.items()
            },
            "template": [_rounded(point) for point in self.template],
            "why": self.why,
        }


def _rounded(values: FloatArray) -> list[float]:
    return [round(float(v), ROUNDING) for v in values]
