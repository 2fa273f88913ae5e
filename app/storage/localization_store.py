"""The localizations: `localizations/ID/steps.jsonl`, one line per time step as in CONTRACT's CLI."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from sqlalchemy import RowMapping, delete, insert, select, update

from app.errors import Conflict, NotFound
from app.storage.data_folder import DataFolder, new_id
from app.storage.database import Database
from app.storage.records import LocalizationRecord, Status
from app.storage.tables import localizations

STEPS_FILE = "steps.jsonl"


class LocalizationStore:
    """Keeps localizations. Thread-safe."""

    def __init__(self, database: Database, folder: DataFolder) -> None:
        self._database = database
        self._folder = folder

    def add(
        self, name: str, model_id: str, log_id: str, options: Mapping[str, Any]
    ) -> LocalizationRecord:
        """A localization that waits for its job."""
        record = LocalizationRecord(
            id=new_id(),
            name=name,
            created=time.time(),
            model_id=model_id,
            log_id=log_id,
            status=Status.QUEUED,
            error=None,
            job_id=None,
            options=dict(options),
            steps=0,
        )
        row = vars(record) | {"options": json.dumps(record.options)}
        with self._database.write() as connection:
            connection.execute(insert(localizations).values(**row))
        return record

    def get(self, localization_id: str) -> LocalizationRecord:
        """The localization with this id.

        Raises:
            NotFound: there is none.
        """
        query = select(localizations).where(localizations.c.id == localization_id)
        with self._database.read() as connection:
            row = connection.execute(query).mappings().first()
        if row is None:
            raise NotFound("localization", localization_id)
        return _record(row)

    def list_all(self, model_id: str | None) -> list[LocalizationRecord]:
        """All of them, or those of a model, the newest first."""
        query = select(localizations).order_by(localizations.c.created.desc())
        if model_id is not None:
            query = query.where(localizations.c.model_id == model_id)
        with self._database.read() as connection:
            return [_record(row) for row in connection.execute(query).mappings()]

    def set(self, localization_id: str, **values: Any) -> None:
        """Notes something on a localization that is there."""
        with self._database.write() as connection:
            connection.execute(
                update(localizations).where(localizations.c.id == localization_id).values(**values)
            )

    def publish(self, localization_id: str, made: Path, steps: int) -> None:
        """Takes over the folder with the steps."""
        self.get(localization_id)
        self._folder.publish(made, self._place(localization_id))
        self.set(localization_id, status=Status.DONE.value, error=None, steps=steps)

    def steps(self, localization_id: str) -> list[dict[str, Any]]:
        """The steps.

        Raises:
            NotFound: there is no such localization.
            Conflict: it is not done.
        """
        record = self.get(localization_id)
        path = self._place(localization_id) / STEPS_FILE
        if record.status is not Status.DONE or not path.is_file():
            raise Conflict(f"the localization is {record.status.value}: it has no steps")
        return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]

    def delete(self, localization_id: str) -> None:
        """Removes a localization and its steps.

        Raises:
            NotFound: there is none.
        """
        self.get(localization_id)
        with self._database.write() as connection:
            connection.execute(delete(localizations).where(localizations.c.id == localization_id))
        self._folder.discard(self._place(localization_id))

    def recover(self, reason: str) -> None:
        """After a crash: what was being made has failed; files that nobody knows are removed."""
        self.remove_orphans()
        for record in self.list_all(None):
            if not record.status.ended:
                self.set(record.id, status=Status.FAILED.value, error=reason)

    def remove_orphans(self) -> None:
        """Removes the files of localizations that went with their model."""
        known = {record.id for record in self.list_all(None)}
        for place in self._folder.localizations.iterdir():
            if place.name not in known:
                self._folder.discard(place)

    def _place(self, localization_id: str) -> Path:
        return self._folder.localizations / localization_id


def _record(row: RowMapping) -> LocalizationRecord:
    values = dict(row)
    values["status"] = Status(values["status"])
    values["options"] = json.loads(values["options"])
    return LocalizationRecord(**values)
