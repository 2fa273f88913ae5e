"""The robot's calibration on the command line: a file that is used when it is there, and written after."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from core.mapping.odometry_calibration import OdometryCalibration
    from core.sensing import SonarRing


def known_calibration(path: Path | None, ring: SonarRing) -> OdometryCalibration | None:
    """What the file says; None without a file.

    Raises:
        InputError: it is no calibration, or that of another robot.
    """
    from core.pipeline.calibration_file import read_calibration

    return read_calibration(path, ring) if path is not None and path.exists() else None


def keep_calibration(path: Path | None, found: OdometryCalibration | None, ring: SonarRing) -> None:
    """Writes what was found into the file, if there is to be one.

    Raises:
        UsageError: nothing was looked for.
        InputError: the file cannot be written.
    """
    from core.errors import InputError, UsageError
    from core.pipeline.calibration_file import write_calibration

    if path is None:
        return
    if found is None:
        raise UsageError("--calibration needs a log and --odometry calibrated or corrected")
    try:
        write_calibration(path, found, ring)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error
