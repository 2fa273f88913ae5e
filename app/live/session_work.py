"""What a worker process does for one live session: reads new scans and takes them in."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Protocol

from app.jobs.tasks import Arguments, Result
from app.jobs.tasks.localize import without_labels
from app.storage.model_facts import facts_of
from core.errors import InputError
from core.geometry import FloatArray, compose, inverse
from core.log_readers.native import parse_header, parse_scan
from core.pipeline.growing_drive import GrowingDrive
from core.pipeline.localizer import Localizer
from core.pipeline.modeller import ModellingOptions
from core.sensing import Scan, SonarRing
from core.topology.model_folder import read_model, write_model

MOST_SCANS = 60
"""Scans taken in at one request, so that a session that has to catch up does not hold up others."""


class SessionWork(Protocol):
    """The state of a session in a worker."""

    def advance(self, size: int) -> Result:
        """Takes in scans that are recorded and not taken in yet, at most `MOST_SCANS`.

        Args:
            size: bytes of the recording that are safe.

        Returns:
            `scans` taken in, `behind`: bytes still to be read, `t` of the last scan, `frame`: pose
            of the odometry's frame in the map's, `grown`: a modelling step was taken, `belief`: a
            localization step.
        """

    def model(self, out: str) -> Result:
        """Writes the model as it is now to a folder that does not exist.

        Returns:
            `facts` of the model, `t` of the last scan in it.
        """


def begin(arguments: Arguments) -> SessionWork:
    """The work of a session: `recording`, `mode`, and of a localization `model`."""
    recording = Reader(Path(arguments["recording"]))
    if arguments["mode"] == "mapping":
        return MappingWork(recording)
    return LocalizationWork(recording, Path(arguments["model"]))


class Reader:
    """Reads a recording scan by scan while it grows."""

    def __init__(self, path: Path) -> None:
        self._path = path
        with path.open("rb") as file:
            header = file.readline()
        self.name, self.ring = parse_header(json.loads(header))
        self._at = len(header)

    def scans(self, size: int) -> list[Scan]:
        """The next scans within the first `size` bytes, at most `MOST_SCANS`."""
        found: list[Scan] = []
        with self._path.open("rb") as file:
            file.seek(self._at)
            while self._at < size and len(found) < MOST_SCANS:
                line = file.readline()
                self._at += len(line)
                found.append(parse_scan(json.loads(line), self.ring))
        return found

    def behind(self, size: int) -> int:
        """Bytes that are left of the first `size`."""
        return max(0, size - self._at)


class MappingWork:
    """Poses, map and model grow."""

    def __init__(self, recording: Reader) -> None:
        self._recording = recording
        self._drive = GrowingDrive(recording.ring, ModellingOptions())
        self._t = 0.0

    def advance(self, size: int) -> Result:
        """See `SessionWork.advance`."""
        scans = self._recording.scans(size)
        steps = [self._drive.add(scan) for scan in scans]
        result: dict[str, Any] = {"scans": len(scans), "behind": self._recording.behind(size)}
        if scans:
            self._t = scans[-1].t
            frame = compose(self._drive.pose, inverse(scans[-1].odometry))
            result |= {"t": self._t, "frame": frame.tolist(), "grown": any(steps)}
        return result

    def model(self, out: str) -> Result:
        """See `SessionWork.model`."""
        write_model(self._drive.model(self._recording.name), Path(out))
        return {"facts": facts_of(Path(out)), "t": self._t}


class LocalizationWork:
    """The robot is looked for in a model."""

    def __init__(self, recording: Reader, model: Path) -> None:
        self._recording = recording
        self._localizer = _localizer(model, recording.ring)
        self._state = self._localizer.start()
        self._frame: FloatArray | None = None

    def model(self, out: str) -> Result:
        """There is none to be written: the robot is looked for in one that is made."""
        raise InputError("a localization makes no model")

    def advance(self, size: int) -> Result:
        """See `SessionWork.advance`; of several steps the last one counts."""
        scans = self._recording.scans(size)
        result: dict[str, Any] = {"scans": len(scans), "behind": self._recording.behind(size)}
        for scan in scans:
            self._state, step = self._localizer.advance(self._state, scan)
            if step is not None:
                result["belief"] = step.as_dict()
                self._frame = compose(step.pose, inverse(scan.odometry))
        if scans:
            result["t"] = scans[-1].t
        if self._frame is not None:
            result["frame"] = self._frame.tolist()
        return result


def _localizer(model: Path, ring: SonarRing) -> Localizer:
    return Localizer(without_labels(read_model(model)), ring)
