"""The models: `models/ID/NNNNNN/` is a model folder as CONTRACT has it, one per revision.

The highest revision is the model; a new one appears by a rename, so that a reader sees the model
before an edit or after it, never in between. What the index holds of a model is only for lists.
"""

from __future__ import annotations

import json
import os
import shutil
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, RowMapping, delete, insert, select, update

from app.errors import Conflict, NotFound
from app.events import ModelEvents
from app.storage.data_folder import DataFolder, new_id, size_on_disk
from app.storage.database import Database
from app.storage.model_facts import TOPOLOGY_FILE, facts_of
from app.storage.records import ModelRecord, Status
from app.storage.search import Sorting, matching, ordering
from app.storage.tables import model_logs, models

EDITED_FILES = frozenset({TOPOLOGY_FILE, "rooms.png", "history.jsonl"})
"""What an edit may write; all other files of a revision are shared with the one before."""
SOURCE_FOLDER = "source"
SORTINGS = ("name", "created", "updated", "status", "nodes", "rooms", "area_m2", "size_bytes")
Edit = Callable[[Path], None]
"""Changes the files of `EDITED_FILES` in a model folder."""


class ModelStore:
    """Keeps models. Thread-safe."""

    def __init__(self, database: Database, folder: DataFolder, events: ModelEvents) -> None:
        self._database = database
        self._folder = folder
        self._events = events
        self._lock = threading.RLock()

    def add(self, name: str, options: Mapping[str, Any], log_ids: Sequence[str]) -> ModelRecord:
        """A new model that has yet to be made."""
        now = time.time()
        row = {
            "id": new_id(),
            "name": name,
            "created": now,
            "updated": now,
            "status": Status.QUEUED,
            "options": json.dumps(dict(options)),
            "labels": "[]",
            "nodes": 0,
            "rooms": 0,
            "area_m2": 0.0,
            "size_bytes": 0,
            "revision": 0,
        }
        with self._database.write() as connection:
            connection.execute(insert(models).values(**row))
            _link_logs(connection, str(row["id"]), log_ids)
        return self.get(str(row["id"]))

    def get(self, model_id: str) -> ModelRecord:
        """The model with this id.

        Raises:
            NotFound: there is none.
        """
        with self._database.read() as connection:
            row = (
                connection.execute(select(models).where(models.c.id == model_id)).mappings().first()
            )
            if row is None:
                raise NotFound("model", model_id)
            return _record(row, _log_ids(connection, [model_id]))

    def search(self, query: str, sorting: Sorting) -> list[ModelRecord]:
        """The models with every word of the query in their name or labels."""
        statement = select(models).where(matching(query, models.c.name, models.c.labels))
        statement = statement.order_by(*ordering(models, sorting, SORTINGS))
        with self._database.read() as connection:
            rows = connection.execute(statement).mappings().all()
            log_ids = _log_ids(connection, [row["id"] for row in rows])
        return [_record(row, log_ids) for row in rows]

    def rename(self, model_id: str, name: str) -> ModelRecord:
        """Gives a model another name.

        Raises:
            NotFound: there is none.
        """
        self._set(model_id, name=name)
        self._events.model_changed(model_id)
        return self.get(model_id)

    def locked(self) -> AbstractContextManager[object]:
        """Nobody else edits, publishes or deletes a model meanwhile."""
        return self._lock

    def set_job(self, model_id: str, job_id: str) -> None:
        """Notes the job that makes the model."""
        self._set(model_id, job_id=job_id, status=Status.QUEUED, error=None)

    def add_source(self, model_id: str, prepared: Path) -> Path:
        """Keeps the files that an imported model is made from; returns their folder."""
        source = self._place(model_id) / SOURCE_FOLDER
        self._folder.publish(prepared, source)
        return source

    def set_status(self, model_id: str, status: Status, error: str | None = None) -> None:
        """Notes how far the job is; a model that was whole before stays whole when it fails."""
        whole = status in (Status.FAILED, Status.CANCELLED) and self.has_files(model_id)
        self._set(model_id, status=Status.DONE if whole else status, error=error)

    def publish(
        self, model_id: str, prepared: Path, facts: Mapping[str, Any], log_ids: Sequence[str]
    ) -> None:
        """Takes over a model folder that a worker has written, as the newest revision.

        Args:
            facts: what the index should know: `nodes`, `rooms`, `area_m2`, `labels`.
            log_ids: the logs that it is made from.
        """
        with self._lock:
            self._switch(model_id, prepared)
            with self._database.write() as connection:
                _link_logs(connection, model_id, log_ids)
            self._index(model_id, facts, status=Status.DONE, error=None)
        self._events.model_changed(model_id)

    def edit(self, model_id: str, edit: Edit) -> None:
        """Makes a revision that differs from the present one by an edit.

        Raises:
            Conflict: the model is not made yet.
            Whatever `edit` raises; the model is then as before.
        """
        with self._lock, self._folder.temporary() as temp:
            present = self.files(model_id)
            prepared = temp / "model"
            _share(present, prepared)
            edit(prepared)
            self._switch(model_id, prepared)
            self._index(model_id, facts_of(self.files(model_id)))
        self._events.model_changed(model_id)

    def files(self, model_id: str) -> Path:
        """The model folder of the newest revision.

        Raises:
            Conflict: the model is not made yet.
        """
        revisions = self._revisions(model_id)
        if not revisions:
            raise Conflict(f"the model {self.get(model_id).name!r} is not made yet")
        return revisions[-1]

    def has_files(self, model_id: str) -> bool:
        """Whether the model was made at least once."""
        return bool(self._revisions(model_id))

    def delete(self, model_id: str) -> None:
        """Removes a model and its files.

        Raises:
            NotFound: there is none.
        """
        with self._lock:
            self.get(model_id)
            with self._database.write() as connection:
                connection.execute(delete(models).where(models.c.id == model_id))
            self._folder.discard(self._place(model_id))
        self._events.model_deleted(model_id)

    def recover(self, reason: str) -> None:
        """Brings files and index together after a crash: what was being made has failed."""
        with self._database.read() as connection:
            status = {row.id: Status(row.status) for row in connection.execute(select(models))}
        for place in self._folder.models.iterdir():
            if place.name not in status:
                self._folder.discard(place)
        for model_id, last in status.items():
            for stale in self._revisions(model_id)[:-1]:
                self._folder.discard(stale)
            if not last.ended:
                self.set_status(model_id, Status.FAILED, reason)
            elif self.has_files(model_id):
                self._index(model_id, facts_of(self.files(model_id)))

    def _place(self, model_id: str) -> Path:
        return self._folder.models / model_id

    def _revisions(self, model_id: str) -> list[Path]:
        place = self._place(model_id)
        return sorted(place.glob("[0-9]*")) if place.is_dir() else []

    def _switch(self, model_id: str, prepared: Path) -> None:
        revisions = self._revisions(model_id)
        number = int(revisions[-1].name) + 1 if revisions else 1
        self._folder.publish(prepared, self._place(model_id) / f"{number:06d}")
        for old in revisions:
            self._folder.discard(old)

    def _index(self, model_id: str, facts: Mapping[str, Any], **values: Any) -> None:
        self._set(
            model_id,
            **values,
            nodes=facts["nodes"],
            rooms=facts["rooms"],
            area_m2=facts["area_m2"],
            labels=json.dumps(facts["labels"], ensure_ascii=False),
            size_bytes=size_on_disk(self._place(model_id)),
            revision=int(self.files(model_id).name),
        )

    def _set(self, model_id: str, **values: Any) -> None:
        statement = update(models).where(models.c.id == model_id)
        with self._database.write() as connection:
            done = connection.execute(statement.values(updated=time.time(), **values))
        if done.rowcount == 0:
            raise NotFound("model", model_id)


def _share(present: Path, prepared: Path) -> None:
    """A copy of a revision in which the files that an edit leaves alone take no space."""
    prepared.mkdir()
    for source in present.iterdir():
        copy = shutil.copyfile if source.name in EDITED_FILES else _link
        copy(source, prepared / source.name)


def _link(source: Path, target: Path) -> None:
    try:
        os.link(source, target)
    except OSError:
        shutil.copyfile(source, target)


def _link_logs(connection: Connection, model_id: str, log_ids: Sequence[str]) -> None:
    connection.execute(delete(model_logs).where(model_logs.c.model_id == model_id))
    for position, log_id in enumerate(log_ids):
        connection.execute(
            insert(model_logs).values(model_id=model_id, log_id=log_id, position=position)
        )


def _log_ids(connection: Connection, model_ids: Sequence[str]) -> dict[str, list[str]]:
    grouped: dict[str, list[str]] = {model_id: [] for model_id in model_ids}
    rows = connection.execute(
        select(model_logs)
        .where(model_logs.c.model_id.in_(model_ids))
        .order_by(model_logs.c.position)
    )
    for row in rows:
        grouped[row.model_id].append(row.log_id)
    return grouped


def _record(row: RowMapping, log_ids: Mapping[str, Sequence[str]]) -> ModelRecord:
    return ModelRecord(
        **{
            **row,
            "status": Status(row["status"]),
            "options": json.loads(row["options"]),
            "labels": tuple(json.loads(row["labels"])),
            "log_ids": tuple(log_ids[row["id"]]),
        }
    )
