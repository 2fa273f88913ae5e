"""What the index knows of logs, models and jobs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any


class Status(StrEnum):
    """How far a job, or the model that it makes, is."""

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"

    @property
    def ended(self) -> bool:
        """True when it will not change any more."""
        return self not in (Status.QUEUED, Status.RUNNING)


@dataclass(frozen=True)
class LogRecord:
    """A stored log. `created` is seconds since the epoch, UTC."""

    id: str
    name: str
    created: float
    scans: int
    sonars: int
    duration_s: float
    distance_m: float
    size_bytes: int


@dataclass(frozen=True)
class ModelRecord:
    """A model, finished or not.

    Attributes:
        options: what it was asked to be made with.
        log_ids: the logs that it is made from, in order; empty for an imported map.
        labels: every label in it, for the search; the truth about labels is its topology.json.
        revision: grows with every change of its files; 0 until it is made.
    """

    id: str
    name: str
    created: float
    updated: float
    status: Status
    error: str | None
    job_id: str | None
    options: Mapping[str, Any]
    log_ids: tuple[str, ...]
    nodes: int
    rooms: int
    area_m2: float
    labels: tuple[str, ...]
    size_bytes: int
    revision: int


@dataclass(frozen=True)
class LocalizationRecord:
    """A localization of a log in a model, finished or not; `steps` is how many there are."""

    id: str
    name: str
    created: float
    model_id: str
    log_id: str
    status: Status
    error: str | None
    job_id: str | None
    options: Mapping[str, Any]
    steps: int


@dataclass(frozen=True)
class CalibrationRecord:
    """What is known of a robot's odometry.

    Attributes:
        ring: fingerprint of the robot's sonar ring.
        model_name: the model whose drive told it.
        kept: seconds since the epoch, UTC.
        found: the fields of `core.mapping.odometry_calibration.OdometryCalibration`.
    """

    ring: str
    model_name: str
    kept: float
    found: Mapping[str, float]


@dataclass(frozen=True)
class JobRecord:
    """A job. `subject_id` names what it makes: the model, say."""

    id: str
    kind: str
    subject_id: str
    status: Status
    error: str | None
    created: float
    started: float | None
    finished: float | None
