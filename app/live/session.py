"""A live session: what it is, where it stands, and scans coming in."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from app.errors import Conflict
from app.live.commits import GroupCommit
from app.live.event_stream import EventStream
from app.live.recording import Recording
from core.errors import LogError
from core.log_readers.native import parse_scan

MODEL_ID = r"^[\w-]{1,64}$"
"""How ids of models look in messages from outside."""
MOST_SCANS = 5000
"""Scans that one message may hold."""
MOST_TOLD = 20
"""Of scans that come together, so many are told to those who listen, the last ones."""


class LiveStatus(StrEnum):
    """How far a session is."""

    RUNNING = "running"
    FINISHING = "finishing"
    ENDED = "ended"


@dataclass(frozen=True)
class LiveRecord:
    """What is kept of a session beside its recording.

    Attributes:
        mode: "mapping" or "localization".
        log_id: the log that it becomes when it is finished.
        model_id: the model that grows, or in which the robot is looked for.
        origin: what tells this robot from others where a connection does not, such as its topic.
    """

    id: str
    mode: str
    name: str
    log_id: str
    model_id: str
    created: float
    status: LiveStatus = LiveStatus.RUNNING
    stored: int = 0
    last_t: float | None = None
    origin: str = ""


@dataclass(frozen=True)
class Acknowledgement:
    """Every scan up to `ack` (s) is safe; None before the first. `duplicates`: of this message."""

    ack: float | None
    stored: int
    duplicates: int


class LiveSession:
    """A session that runs. Event loop's thread only."""

    def __init__(self, record: LiveRecord, recording: Recording, commits: GroupCommit) -> None:
        self.record = record
        self.recording = recording
        self.events = EventStream()
        self.duplicates = 0
        self.frame: list[float] = [0.0, 0.0, 0.0]
        self._commits = commits
        self._latest_t = recording.last_t

    @property
    def simulated(self) -> bool:
        """Whether the robot says in its header that it is none."""
        return self.recording.header.get("simulated") is True

    async def take(self, records: Any) -> Acknowledgement:
        """Keeps scans: one scan line or a list of them; returns once they are safe.

        Scans that are not newer than the latest are counted, and left out.

        Raises:
            LogError: a scan is wrong; none of the message is kept.
            Conflict: the session has ended.
            OSError: the disk is full.
        """
        if self.record.status is not LiveStatus.RUNNING:
            raise Conflict("the session has ended: no more scans are taken")
        fresh, duplicates, latest = self._sorted_out(records)
        self.duplicates += duplicates
        if fresh:
            before, self._latest_t = self._latest_t, latest
            try:
                await self._commits.store(self.recording, fresh)
            except OSError:
                self._latest_t = before
                raise
            for scan in fresh[-MOST_TOLD:]:
                self.events.send(self._pose_event(scan))
        return Acknowledgement(self.recording.last_t, self.recording.stored, duplicates)

    def _pose_event(self, scan: dict[str, Any]) -> dict[str, Any]:
        """Where the robot's odometry puts it, what it hears there, and how much is safe."""
        return {
            "type": "pose",
            "t": scan["t"],
            "pose": scan["odom"],
            "ranges": scan["ranges"],
            "stored": self.recording.stored,
            "distance_m": round(self.recording.distance_m, 3),
        }

    def _sorted_out(self, records: Any) -> tuple[list[dict[str, Any]], int, float | None]:
        given = records if isinstance(records, list) else [records]
        if len(given) > MOST_SCANS:
            raise LogError(f"{len(given)} scans in one message; send at most {MOST_SCANS}")
        fresh, duplicates, latest = [], 0, self._latest_t
        for i, record in enumerate(given):
            try:
                scan = parse_scan(record, self.recording.ring)
            except LogError as error:
                where = f"scan {i + 1} of {len(given)}: " if len(given) > 1 else ""
                raise LogError(f"{where}{error}") from None
            if latest is not None and scan.t <= latest:
                duplicates += 1
                continue
            latest = scan.t
            fresh.append(record)
        return fresh, duplicates, latest
