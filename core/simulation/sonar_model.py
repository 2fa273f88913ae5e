"""The numbers of the sonar physics."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class SonarModel:
    """The physics of the echoes. Strengths are relative to a flat wall met squarely at 1 m.

    Attributes:
        ray_spacing: between neighbouring rays (rad).
        beam_share: rays leave over this multiple of the beam width (the fringes are weak, not mute).
        bounces: reflections followed.
        threshold: weakest strength that is detected.
        threshold_spread: its scatter from reading to reading (standard deviation of its logarithm).
        mirror_loss_with_range, scatter_loss_with_range: strength falls with range to this power.
        edge_strength: of a convex edge.
        capture: a returning ray counts when it passes within this distance of the transducer (m),
            plus half a ray spacing at the length of its path.
        noise: standard deviation of the range (m); noise_per_metre: more of it per metre of range.
        lateness: a just detected echo is measured this much too long (m).
        dropouts: share of readings lost; outliers: share replaced by any range;
        crosstalk: share replaced by the echo of another sonar's ping, which is too short.
        step: ranges are whole multiples of this (m).
    """

    ray_spacing: float = math.radians(2.5)
    beam_share: float = 1.5
    bounces: int = 4
    threshold: float = 0.05
    threshold_spread: float = 0.35
    mirror_loss_with_range: float = 1.0
    scatter_loss_with_range: float = 1.5
    edge_strength: float = 0.12
    capture: float = 0.03
    noise: float = 0.010
    noise_per_metre: float = 0.005
    lateness: float = 0.02
    dropouts: float = 0.02
    outliers: float = 0.01
    crosstalk: float = 0.01
    step: float = 0.01


NOISY = SonarModel(noise=0.03, dropouts=0.06, outliers=0.06)
"""The "noisy sensor" of the experiments: 6 % outliers, 6 % drop-outs, 3 cm."""
