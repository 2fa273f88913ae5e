"""The drive as it is mapped: the part of a log that belongs together, and its poses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from core.errors import InputError
from core.pipeline.odometry import OdometryChoice, OdometryResult, trajectory_for
from core.progress import Progress, no_progress
from core.sensing import RobotLog, Trajectory

CHOICES: tuple[OdometryChoice, ...] = ("raw", "calibrated", "corrected")


@dataclass(frozen=True)
class CorrectedDrive:
    """What a map is made of.

    Attributes:
        log: the scans that belong together.
        trajectory: one pose for each of them.
        whole: the result for the whole log.
    """

    log: RobotLog
    trajectory: Trajectory
    whole: OdometryResult

    def provenance(self) -> dict[str, Any]:
        """What was done to the odometry, for provenance.json."""
        whole = self.whole
        found = whole.calibration
        return {
            "used": whole.used,
            "scans": list(whole.part),
            "sentences": list(whole.sentences),
            "calibration": None
            if found is None
            else {
                "distance_scale": found.distance_scale,
                "distance_scale_sigma": found.distance_scale_sigma,
                "turn_scale": found.turn_scale,
                "turn_scale_sigma": found.turn_scale_sigma,
                "drift_per_metre": found.drift_per_metre,
                "drift_per_metre_sigma": found.drift_per_metre_sigma,
            },
            "closures": [
                {
                    "t_source": round(closure.t_source, 3),
                    "t_target": round(closure.t_target, 3),
                    "score": round(float(closure.score), 4),
                    "accepted": bool(closure.accepted),
                    "reason": closure.reason,
                }
                for closure in whole.closures
            ],
        }


def corrected_drive(
    log: RobotLog, choice: OdometryChoice, progress: Progress = no_progress
) -> CorrectedDrive:
    """The scans and poses to map a log at.

    Raises:
        InputError: there is no such choice.
    """
    if choice not in CHOICES:
        raise InputError(f"odometry {choice!r}: choose raw, calibrated or corrected")
    whole = trajectory_for(log.without_truth(), choice, progress)
    part = np.arange(*whole.part)
    return CorrectedDrive(log.taken(part), whole.trajectory.taken(part), whole)
