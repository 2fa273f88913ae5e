"""The models: their files, and an index of them for lists and searches."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sqlalchemy import delete, insert, select, update

from app.errors import Conflict, NotFound
from app.events import ModelEvents
from app.storage.data_folder import DataFolder, new_id
from app.storage.database import Database
from app.storage.edit_history import EditHistory
from app.storage.model_facts import facts_of
from app.storage.model_files import Edit, ModelFiles
from app.storage.model_rows import link_logs, log_ids_of, record_of, row_of
from app.storage.records import ModelRecord, Status
from app.storage.search import Sorting, matching, ordering
from app.storage.tables import models

if TYPE_CHECKING:
    from core.topology import Model

SORTINGS = ("name", "created", "updated", "status", "nodes", "rooms", "area_m2", "size_bytes")


class ModelStore:
    """Keeps models. Thread-safe."""

    def __init__(self, database: Database, folder: DataFolder, events: ModelEvents) -> None:
        self._database = database
        self._files = ModelFiles(folder)
        self._events = events
        self._lock = threading.RLock()

    def add(self, name: str, options: Mapping[str, Any], log_ids: Sequence[str]) -> ModelRecord:
        """A new model that has yet to be made."""
        now = time.time()
        record = ModelRecord(
            id=new_id(),
            name=name,
            created=now,
            updated=now,
            status=Status.QUEUED,
            error=None,
            job_id=None,
            options=options,
            log_ids=tuple(log_ids),
            nodes=0,
            rooms=0,
            area_m2=0.0,
            labels=(),
            size_bytes=0,
            revision=0,
        )
        with self._database.write() as connection:
            connection.execute(insert(models).values(**row_of(record)))
            link_logs(connection, record.id, log_ids)
        return record

    def get(self, model_id: str) -> ModelRecord:
        """The model with this id.

        Raises:
            NotFound: there is none.
        """
        statement = select(models).where(models.c.id == model_id)
        with self._database.read() as connection:
            row = connection.execute(statement).mappings().first()
            if row is None:
                raise NotFound("model", model_id)
            return record_of(row, log_ids_of(connection, [model_id]))

    def search(self, query: str, sorting: Sorting) -> list[ModelRecord]:
        """The models with every word of the query in their name or labels."""
        statement = select(models).where(matching(query, models.c.name, models.c.labels))
        statement = statement.order_by(*ordering(models, sorting, SORTINGS))
        with self._database.read() as connection:
            rows = connection.execute(statement).mappings().all()
            log_ids = log_ids_of(connection, [row["id"] for row in rows])
        return [record_of(row, log_ids) for row in rows]

    def rename(self, model_id: str, name: str) -> ModelRecord:
        """Gives a model another name.

        Raises:
            NotFound: there is none.
        """
        self._set(model_id, name=name, updated=time.time())
        self._events.model_changed(model_id)
        return self.get(model_id)

    def locked(self) -> AbstractContextManager[object]:
        """Nobody else edits, publishes or deletes a model meanwhile."""
        return self._lock

    def add_source(self, model_id: str, prepared: Path) -> Path:
        """Keeps the files that an imported model is made from; returns their folder."""
        return self._files.add_source(model_id, prepared)

    def set_job(self, model_id: str, job_id: str) -> None:
        """Notes the job that makes the model."""
        self._set(model_id, job_id=job_id, status=Status.QUEUED, error=None)

    def set_running(self, model_id: str) -> None:
        """Notes that the model is being made, unless its job has ended already."""
        waiting = (models.c.id == model_id) & (models.c.status == Status.QUEUED)
        with self._database.write() as connection:
            connection.execute(update(models).where(waiting).values(status=Status.RUNNING))

    def set_ended(self, model_id: str, status: Status, error: str | None) -> None:
        """Notes that the model was not made; one that was whole before stays whole."""
        whole = self._files.history(model_id) is not None
        self._set(model_id, status=Status.DONE if whole else status, error=error)

    def publish(
        self,
        model_id: str,
        prepared: Path,
        log_ids: Sequence[str],
        facts: Mapping[str, Any],
        labels_from: str | None = None,
        edit: str | None = None,
    ) -> None:
        """Takes over a model folder that a worker has written, as the newest revision.

        Args:
            log_ids: the logs that it is made from.
            facts: what `facts_of` tells of the folder.
            labels_from: the model whose labels, as they are now, go along by overlap; when it is
                this very model, so do the ids of nodes, rooms and doorways.
            edit: what was done in words, when undo is to lead back to the model before.

        Raises:
            NotFound: the model was deleted meanwhile.
        """
        with self._lock:
            self.get(model_id)
            named = self._files.present(labels_from) if labels_from else None
            if named is not None:
                from app.storage.label_edit import carry_identity, carry_labels

                carry = carry_identity if labels_from == model_id else carry_labels
                carry(named, prepared)
                facts = facts_of(prepared)
            if edit is None:
                self._files.renew(model_id, prepared)
            else:
                self._files.remake(model_id, prepared, edit)
            with self._database.write() as connection:
                link_logs(connection, model_id, log_ids)
            self._index(model_id, facts, status=Status.DONE, error=None, updated=time.time())
        self._events.model_changed(model_id)

    def edit(self, model_id: str, edit: Edit, while_made: bool = False) -> ModelRecord:
        """Makes a revision that differs from the present one by an edit.

        Args:
            while_made: allowed while a job makes the model anew, which then takes the edit along.

        Raises:
            NotFound: there is no such model.
            Conflict: the model is not made yet, or a job is at it.
            Whatever `edit` raises; the model is then as before.
        """
        with self._lock:
            history = self._editable(model_id, while_made)
            self._files.edit(model_id, history, edit)
            return self._changed(model_id)

    def undo(self, model_id: str, revision: int | None = None) -> ModelRecord:
        """Takes the last edit back.

        Args:
            revision: the one that is expected; None undoes whatever was last.

        Raises:
            NotFound: there is no such model.
            Conflict: there is nothing to undo, the model has changed since, or a job is at it.
        """
        with self._lock:
            history = self._editable(model_id)
            _check_revision(history, revision)
            if not history.past:
                raise Conflict("there is nothing to undo")
            self._files.turn(model_id, history.undone())
            return self._changed(model_id)

    def redo(self, model_id: str, revision: int | None = None) -> ModelRecord:
        """Does the edit again that was taken back last; arguments and errors as for `undo`."""
        with self._lock:
            history = self._editable(model_id)
            _check_revision(history, revision)
            if not history.future:
                raise Conflict("there is nothing to redo")
            self._files.turn(model_id, history.redone())
            return self._changed(model_id)

    def history(self, model_id: str) -> EditHistory | None:
        """What can be undone and redone; None when the model is not made yet."""
        return self._files.history(model_id)

    def folder(self, model_id: str) -> Path:
        """The model folder.

        Raises:
            NotFound: there is no such model.
            Conflict: it is not made yet.
        """
        present = self._files.present(model_id)
        if present is None:
            raise Conflict(f"the model {self.get(model_id).name!r} is not made yet")
        return present

    def load(self, model_id: str) -> Model | None:
        """The model itself; None where there is none or it is not made yet."""
        return self._files.load(model_id)

    def delete(self, model_id: str) -> None:
        """Removes a model and its files.

        Raises:
            NotFound: there is none.
        """
        with self._lock:
            self.get(model_id)
            with self._database.write() as connection:
                connection.execute(delete(models).where(models.c.id == model_id))
            self._files.remove(model_id)
        self._events.model_deleted(model_id)

    def recover(self, reason: str) -> None:
        """Brings files and index together after a crash: what was being made has failed."""
        with self._database.read() as connection:
            status_of = {row.id: Status(row.status) for row in connection.execute(select(models))}
        for model_id in self._files.known() - set(status_of):
            self._files.remove(model_id)
        for model_id, status in status_of.items():
            self._files.recover(model_id)
            if not status.ended:
                self.set_ended(model_id, Status.FAILED, reason)
            if self._files.history(model_id) is not None:
                self._index(model_id, facts_of(self.folder(model_id)))

    def _editable(self, model_id: str, while_made: bool = False) -> EditHistory:
        record, history = self.get(model_id), self._files.history(model_id)
        if history is None:
            raise Conflict(f"the model {record.name!r} is not made yet")
        if not record.status.ended and not while_made:
            raise Conflict(
                f"the model {record.name!r} is being made; wait for its job or cancel it"
            )
        return history

    def _changed(self, model_id: str) -> ModelRecord:
        """Brings the index up to date after a change and tells of it."""
        self._index(model_id, facts_of(self.folder(model_id)), updated=time.time())
        self._events.model_changed(model_id)
        return self.get(model_id)

    def _index(self, model_id: str, facts: Mapping[str, Any], **values: Any) -> None:
        history = self._files.history(model_id)
        self._set(
            model_id,
            **values,
            nodes=facts["nodes"],
            rooms=facts["rooms"],
            area_m2=facts["area_m2"],
            labels=json.dumps(facts["labels"], ensure_ascii=False),
            size_bytes=self._files.size(model_id),
            revision=0 if history is None else history.revision,
        )

    def _set(self, model_id: str, **values: Any) -> None:
        with self._database.write() as connection:
            done = connection.execute(
                update(models).where(models.c.id == model_id).values(**values)
            )
        if done.rowcount == 0:
            raise NotFound("model", model_id)


def _check_revision(history: EditHistory, revision: int | None) -> None:
    if revision is not None and revision != history.revision:
        raise Conflict("the model has changed since")
