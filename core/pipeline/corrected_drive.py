"""The drive as it is mapped: the part of a log that belongs together, and its poses."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from core.errors import InputError
from core.mapping.drift_edits import DriftEdits
from core.mapping.odometry_calibration import OdometryCalibration
from core.pipeline.odometry import (
    OdometryChoice,
    OdometryConfig,
    OdometryResult,
    trajectory_for,
)
from core.progress import Progress, no_progress
from core.sensing import RobotLog, Trajectory
from core.topology import Model

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
            "calibration": None if found is None else asdict(found),
            "closures": [
                {
                    "id": closure.id,
                    "t_source": round(closure.t_source, 3),
                    "t_target": round(closure.t_target, 3),
                    "score": round(float(closure.score), 4),
                    "accepted": bool(closure.accepted),
                    "reason": closure.reason,
                    "by_person": closure.by_person,
                }
                for closure in whole.closures
            ],
        }


def corrected_drive(
    log: RobotLog,
    choice: OdometryChoice,
    progress: Progress = no_progress,
    edits: DriftEdits | None = None,
    known: OdometryCalibration | None = None,
) -> CorrectedDrive:
    """The scans and poses to map a log at.

    Args:
        log: the drive.
        choice: which poses.
        progress: told all along.
        edits: what a person says about the drift.
        known: the robot's calibration from an earlier drive.

    Raises:
        InputError: there is no such choice, or the edits speak of another drive.
    """
    if choice not in CHOICES:
        raise InputError(f"odometry {choice!r}: choose raw, calibrated or corrected")
    whole = trajectory_for(
        log.without_truth(), choice, progress, OdometryConfig().knowing(known), edits
    )
    part = np.arange(*whole.part)
    return CorrectedDrive(log.taken(part), whole.trajectory.taken(part), whole)


def calibration_of(model: Model) -> OdometryCalibration | None:
    """What the drive of a model told about its robot; None for a map or odometry left raw."""
    found = model.provenance.get("odometry", {}).get("calibration")
    return None if found is None else OdometryCalibration(**found)
