"""A log that was read, with its report."""

from __future__ import annotations

from dataclasses import dataclass

from core.log_readers.log_report import LogReport
from core.sensing.robot_log import RobotLog


@dataclass(frozen=True)
class LoadedLog:
    """A drive and what is to be said about it."""

    log: RobotLog
    report: LogReport
