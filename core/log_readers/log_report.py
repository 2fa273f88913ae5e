"""The report that comes with every log: what is in it, what is odd, and whether it will make a map."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from core.log_readers.draft_log import Finding


@dataclass(frozen=True)
class Gap:
    """A time without scans: when it starts (s), how long (s), how far the robot got in it (m)."""

    t: float
    seconds: float
    metres: float


@dataclass(frozen=True)
class Jump:
    """A step of the odometry that no robot drives: when (s), how far (m), how much turn (rad)."""

    t: float
    metres: float
    radians: float


@dataclass(frozen=True)
class LogReport:
    """What is to be said about a log.

    Attributes:
        format: name of the format it was read from.
        name: of the log.
        scans: N.
        sonars: S.
        duration_s: from the first scan to the last.
        distance_m: driven according to the odometry.
        turn_rad: turned, left and right added up.
        extent_m: diagonal of the box around the drive.
        rate_hz: one over the median time between scans; 0 with one scan.
        no_echo: share of readings without echo.
        no_echo_per_sonar: likewise (S,).
        latched: share of readings that only repeat an earlier measurement.
        latched_per_sonar: likewise (S,).
        gap_count: number of gaps; `gaps` has the longest of them.
        jump_count: number of jumps; `jumps` has the largest of them.
        clock: what was wrong with the time stamps.
        skipped: what was left out, and why.
        notes: what is odd but was accepted.
        good_for_map: whether the log is good enough for a map.
        verdict: the same in words, and what to drive next if not; one sentence an entry.
    """

    format: str
    name: str
    scans: int
    sonars: int
    duration_s: float
    distance_m: float
    turn_rad: float
    extent_m: float
    rate_hz: float
    no_echo: float
    no_echo_per_sonar: tuple[float, ...]
    latched: float
    latched_per_sonar: tuple[float, ...]
    gap_count: int
    gaps: tuple[Gap, ...]
    jump_count: int
    jumps: tuple[Jump, ...]
    clock: tuple[Finding, ...]
    skipped: tuple[Finding, ...]
    notes: tuple[Finding, ...]
    good_for_map: bool
    verdict: tuple[str, ...]

    def as_dict(self) -> dict[str, Any]:
        """The report as JSON can hold it."""
        return {key: _plain(value) for key, value in asdict(self).items()}


def _plain(value: Any) -> Any:
    """Tuples as lists, floats rounded to what a person reads."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_plain(item) for item in value]
    return round(value, 4) if isinstance(value, float) else value
