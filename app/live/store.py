"""Live sessions on the disk: `live/ID/` holds `session.json` and, until it is a log, `log.jsonl`."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

from app.live.recording import Recording
from app.live.session import LiveRecord, LiveStatus
from app.storage.data_folder import DataFolder

SESSION_FILE, RECORDING_FILE = "session.json", "log.jsonl"


class LiveStore:
    """Keeps what sessions need to go on after a crash."""

    def __init__(self, folder: DataFolder) -> None:
        self._folder = folder
        self._root = folder.root / "live"
        self._root.mkdir(exist_ok=True)

    def create(self, record: LiveRecord, header: dict[str, Any]) -> Recording:
        """A new session, on the disk when this returns.

        Raises:
            LogError, TooLargeError: the header is none.
        """
        with self._folder.temporary() as temp:
            prepared = temp / "session"
            prepared.mkdir()
            Recording.create(prepared / RECORDING_FILE, header)
            (prepared / SESSION_FILE).write_text(_text(record), encoding="utf-8")
            self._folder.publish(prepared, self._root / record.id)
        return self.recording(record.id)

    def recording(self, session_id: str) -> Recording:
        """The recording of a session that is not ended."""
        return Recording(self.recording_file(session_id))

    def recording_file(self, session_id: str) -> Path:
        """Where a recording lies."""
        return self._root / session_id / RECORDING_FILE

    def save(self, record: LiveRecord) -> None:
        """Notes where a session stands, in one step."""
        self._folder.replace_file(self._root / record.id / SESSION_FILE, _text(record).encode())

    def remove_recording(self, session_id: str) -> None:
        """Removes the recording of a session whose log is kept."""
        self.recording_file(session_id).unlink(missing_ok=True)

    def records(self) -> Iterator[LiveRecord]:
        """All sessions ever."""
        for path in sorted(self._root.glob(f"*/{SESSION_FILE}")):
            fields = json.loads(path.read_text(encoding="utf-8"))
            yield LiveRecord(**{**fields, "status": LiveStatus(fields["status"])})


def _text(record: LiveRecord) -> str:
    return json.dumps(asdict(record), ensure_ascii=False)
