"""A robot's calibration as a small JSON file, to be used again on its next logs."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from core.errors import InputError
from core.log_readers.safe_yaml import describe
from core.mapping.odometry_calibration import OdometryCalibration
from core.sensing import SonarRing

Share = Annotated[float, Field(gt=-0.5, lt=0.5)]
Doubt = Annotated[float, Field(gt=0, le=1)]


class CalibrationFile(BaseModel):
    """What the file holds; `ring` tells which robot it is of."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
    format: Literal["echorooms-calibration"] = "echorooms-calibration"
    version: Literal[1] = 1
    ring: str = Field(max_length=64)
    distance_scale: Share
    turn_scale: Share
    drift_per_metre: Annotated[float, Field(ge=-math.pi, le=math.pi)]
    distance_scale_sigma: Doubt
    turn_scale_sigma: Doubt
    drift_per_metre_sigma: Doubt

    @property
    def calibration(self) -> OdometryCalibration:
        """The calibration itself."""
        values = self.model_dump(exclude={"format", "version", "ring"})
        return OdometryCalibration(**values)


def write_calibration(path: Path, calibration: OdometryCalibration, ring: SonarRing) -> None:
    """Writes or replaces the file."""
    content = CalibrationFile(ring=ring.fingerprint, **asdict(calibration))
    path.write_text(content.model_dump_json(indent=1) + "\n", encoding="utf-8")


def read_calibration(path: Path, ring: SonarRing) -> OdometryCalibration:
    """Reads the file.

    Raises:
        InputError: it cannot be read, is something else, or belongs to a robot with another ring.
    """
    try:
        content = CalibrationFile.model_validate(json.loads(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise InputError(f"{path.name}: {error.strerror}") from error
    except ValidationError as error:
        raise InputError(f"{path.name} is no calibration: {describe(error)}") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path.name} is no JSON: {error}") from error
    if content.ring != ring.fingerprint:
        raise InputError(
            f"{path.name} is the calibration of a robot with another sonar ring; "
            "give another file to make one of this robot"
        )
    return content.calibration
