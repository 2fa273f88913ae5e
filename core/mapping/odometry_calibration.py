"""What a log tells about its robot's odometry.

The pose graph estimates the systematic errors together with the poses, so that every closure and every
wall speaks about them; what they leave open stays as uncertain as it was.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from core.geometry import FloatArray
from core.mapping.odometry_model import OdometryNoise

CHANGE = 0.25
"""How much a robot changes between two drives (worn tyres, another floor), as a share of how much
robots differ from each other."""


@dataclass(frozen=True)
class OdometryCalibration:
    """Systematic errors of a robot's odometry with their standard deviations.

    The true motion is the odometry's with distances times `1 + distance_scale`, turns times
    `1 + turn_scale` and `drift_per_metre` (rad) added per metre.
    """

    distance_scale: float
    turn_scale: float
    drift_per_metre: float
    distance_scale_sigma: float
    turn_scale_sigma: float
    drift_per_metre_sigma: float

    @classmethod
    def of(cls, error: FloatArray, sigma: FloatArray) -> OdometryCalibration:
        """From (3,) errors and standard deviations in the order of the fields."""
        return cls(*(float(v) for v in error), *(float(v) for v in sigma))

    @property
    def error(self) -> FloatArray:
        """(3,) distance scale, turn scale, drift per metre."""
        return np.array([self.distance_scale, self.turn_scale, self.drift_per_metre])

    @property
    def sigma(self) -> FloatArray:
        """(3,) their standard deviations."""
        return np.array(
            [self.distance_scale_sigma, self.turn_scale_sigma, self.drift_per_metre_sigma]
        )

    def known_before(self, noise: OdometryNoise) -> OdometryNoise:
        """What is known of the robot's next drive: this, a little less surely than now.

        Args:
            noise: of any robot.
        """
        older = np.hypot(self.sigma, CHANGE * noise.systematic)
        sigma = np.minimum(older, noise.systematic)
        scale, turn, drift = (float(value) for value in sigma)
        expected = (self.distance_scale, self.turn_scale, self.drift_per_metre)
        return replace(
            noise, distance_scale=scale, turn_scale=turn, drift_per_metre=drift, expected=expected
        )

    def sentences(self, sigmas: float = 2.0) -> tuple[str, ...]:
        """The findings in words; an error below `sigmas` standard deviations is called unclear."""
        out = []
        for value, sigma, what, more, less in (
            (self.turn_scale, self.turn_scale_sigma, "turns", "more", "less"),
            (self.distance_scale, self.distance_scale_sigma, "drives", "farther", "less far"),
        ):
            if abs(value) >= sigmas * sigma:
                way = more if value > 0 else less
                out.append(
                    f"Your robot {what} {100 * abs(value):.1f} % {way} than its odometry says "
                    f"(±{100 * sigma:.1f} %)."
                )
        if abs(self.drift_per_metre) >= sigmas * self.drift_per_metre_sigma:
            side = "left" if self.drift_per_metre > 0 else "right"
            out.append(
                f"It drifts to the {side} by {math.degrees(abs(self.drift_per_metre)):.2f} degrees a "
                f"metre (±{math.degrees(self.drift_per_metre_sigma):.2f}) without its odometry noticing."
            )
        return tuple(out) or ("No systematic error of the odometry stands out in this log.",)
