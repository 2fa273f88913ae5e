"""The jobs: what was asked, and how it ended. How far a running one is, only its runner knows."""

from __future__ import annotations

import time
from dataclasses import replace

from sqlalchemy import ColumnElement, insert, select, update

from app.errors import NotFound
from app.storage.data_folder import new_id
from app.storage.database import Database
from app.storage.records import JobRecord, Status
from app.storage.tables import jobs


class JobStore:
    """Keeps jobs. Thread-safe."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def add(self, kind: str, subject_id: str) -> JobRecord:
        """A new job, queued."""
        record = JobRecord(new_id(), kind, subject_id, Status.QUEUED, None, time.time(), None, None)
        with self._database.write() as connection:
            connection.execute(insert(jobs).values(**vars(record)))
        return record

    def get(self, job_id: str) -> JobRecord:
        """The job with this id.

        Raises:
            NotFound: there is none.
        """
        with self._database.read() as connection:
            row = connection.execute(select(jobs).where(jobs.c.id == job_id)).mappings().first()
        if row is None:
            raise NotFound("job", job_id)
        return JobRecord(**{**row, "status": Status(row["status"])})

    def start(self, job: JobRecord) -> JobRecord:
        """Notes that a job runs from now on, unless it has ended already."""
        running = replace(job, status=Status.RUNNING, started=time.time())
        return self._save(running, jobs.c.status == Status.QUEUED)

    def end(self, job: JobRecord, status: Status, error: str | None) -> JobRecord:
        """Notes how a job ended."""
        return self._save(replace(job, status=status, error=error, finished=time.time()))

    def fail_unended(self, reason: str) -> None:
        """Marks what was queued or running when the server died."""
        unended = jobs.c.status.in_((Status.QUEUED, Status.RUNNING))
        with self._database.write() as connection:
            connection.execute(
                update(jobs)
                .where(unended)
                .values(status=Status.FAILED, error=reason, finished=time.time())
            )

    def _save(self, job: JobRecord, *conditions: ColumnElement[bool]) -> JobRecord:
        statement = update(jobs).where(jobs.c.id == job.id, *conditions)
        with self._database.write() as connection:
            connection.execute(statement.values(**vars(job)))
        return job
