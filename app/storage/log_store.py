"""The logs: `logs/ID/` holds `log.jsonl.gz` (native), `report.json` and the upload as it came."""

from __future__ import annotations

import gzip
import json
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from sqlalchemy import RowMapping, delete, insert, select, update

from app.errors import Conflict, NotFound
from app.storage.data_folder import DataFolder, new_id, size_on_disk
from app.storage.database import Database
from app.storage.log_files import NATIVE_FILE, REPORT_FILE
from app.storage.records import LogRecord
from app.storage.search import Sorting, matching, ordering
from app.storage.tables import localizations, logs, model_logs, models

SORTINGS = ("name", "created", "scans", "duration_s", "distance_m", "size_bytes")
NAMED_MODELS = 3
"""How many of the models that use a log an error names."""


class LogStore:
    """Keeps logs. Thread-safe."""

    def __init__(self, database: Database, folder: DataFolder) -> None:
        self._database = database
        self._folder = folder

    def add(
        self, prepared: Path, summary: Mapping[str, Any], log_id: str | None = None
    ) -> LogRecord:
        """Takes over a folder that a worker has prepared, as a new log.

        Args:
            log_id: an id that was promised before the log was whole (a live session).
        """
        record = LogRecord(
            id=log_id or new_id(), created=time.time(), size_bytes=size_on_disk(prepared), **summary
        )
        self._folder.publish(prepared, self._place(record.id))
        with self._database.write() as connection:
            connection.execute(insert(logs).values(**vars(record)))
        return record

    def get(self, log_id: str) -> LogRecord:
        """The log with this id.

        Raises:
            NotFound: there is none.
        """
        with self._database.read() as connection:
            row = connection.execute(select(logs).where(logs.c.id == log_id)).mappings().first()
        if row is None:
            raise NotFound("log", log_id)
        return _record(row)

    def search(self, query: str, sorting: Sorting) -> list[LogRecord]:
        """The logs whose name contains every word of the query."""
        statement = select(logs).where(matching(query, logs.c.name))
        statement = statement.order_by(*ordering(logs, sorting, SORTINGS))
        with self._database.read() as connection:
            return [_record(row) for row in connection.execute(statement).mappings()]

    def rename(self, log_id: str, name: str) -> LogRecord:
        """Gives a log another name.

        Raises:
            NotFound: there is none.
        """
        with self._database.write() as connection:
            connection.execute(update(logs).where(logs.c.id == log_id).values(name=name))
        return self.get(log_id)

    def delete(self, log_id: str) -> None:
        """Removes a log and its files.

        Raises:
            NotFound: there is none.
            Conflict: a model or a localization uses it.
        """
        self.get(log_id)
        with self._database.write() as connection:
            users = connection.execute(
                select(models.c.name)
                .join(model_logs, model_logs.c.model_id == models.c.id)
                .where(model_logs.c.log_id == log_id)
                .order_by(models.c.created)
            ).scalars()
            names = list(users) + list(
                connection.execute(
                    select(localizations.c.name).where(localizations.c.log_id == log_id)
                ).scalars()
            )
            if names:
                raise Conflict(_in_use(names))
            connection.execute(delete(logs).where(logs.c.id == log_id))
        self._folder.discard(self._place(log_id))

    def report(self, log_id: str) -> dict[str, Any]:
        """The report that was made when the log was read."""
        path = self._place(log_id) / REPORT_FILE
        report: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        return report

    def ring_of(self, log_id: str) -> str:
        """The fingerprint of the sonar ring that the log was recorded with."""
        from core.log_readers.native_line import parse_header

        with gzip.open(self.native_file(log_id), "rt", encoding="utf-8") as file:
            _, ring = parse_header(json.loads(file.readline()))
        return ring.fingerprint

    def native_file(self, log_id: str) -> Path:
        """The log in the native format."""
        return self._place(log_id) / NATIVE_FILE

    def remove_orphans(self) -> None:
        """Removes the files of logs that the index does not know (a crash between the two)."""
        with self._database.read() as connection:
            known = set(connection.execute(select(logs.c.id)).scalars())
        for place in self._folder.logs.iterdir():
            if place.name not in known:
                self._folder.discard(place)

    def _place(self, log_id: str) -> Path:
        return self._folder.logs / log_id


def _record(row: RowMapping) -> LogRecord:
    return LogRecord(**row)


def _in_use(names: list[str]) -> str:
    shown = ", ".join(repr(name) for name in names[:NAMED_MODELS])
    more = f" and {len(names) - NAMED_MODELS} more" if len(names) > NAMED_MODELS else ""
    return f"the log is in use by {shown}{more}; delete what uses it first"
