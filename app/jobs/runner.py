"""The queue of jobs: a few at a time, with progress, cancelling and somebody watching."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Coroutine, Iterator
from dataclasses import dataclass, replace
from typing import Any, Protocol

from app.storage.job_store import JobStore
from app.storage.records import JobRecord, Status
from core.errors import EchoRoomsError

logger = logging.getLogger(__name__)
STOPPED = "the server was stopped while the job was waiting or running; start it again"
INTERNAL = "failed for a reason that only the server's log tells"


class Work(Protocol):
    """What a job does."""

    async def run(self, job: ActiveJob) -> None:
        """Does it. Raises EchoRoomsError where it fails; is cancelled by asyncio."""

    def ended(self, status: Status, error: str | None) -> None:
        """Notes how it ended; called in a thread."""


@dataclass(frozen=True)
class JobView:
    """A job as it is now: its record, the finished share (0..1), and what is being done."""

    record: JobRecord
    progress: float
    what: str


class ActiveJob:
    """A job that is queued or running. Lives in the event loop."""

    def __init__(self, record: JobRecord) -> None:
        self.record = record
        self.progress = 0.0
        self.what = "waiting for other jobs"
        self.cancel_requested = False
        self.over = asyncio.Event()
        self._work: asyncio.Task[None] | None = None
        self._stop = False
        self._committing = False
        self.changes = 0
        self._changed = asyncio.Event()

    def report(self, share: float, what: str) -> None:
        """Notes how far the work is (a `Progress`)."""
        self.progress, self.what = max(self.progress, share), what
        self.changed()

    def changed(self) -> None:
        """Wakes everybody who watches."""
        self.changes += 1
        self._changed.set()
        self._changed = asyncio.Event()

    async def wait(self, seen: int, seconds: float) -> bool:
        """Waits until there are more changes than those seen; False if none came in time."""
        if self.changes == seen:
            try:
                async with asyncio.timeout(seconds):
                    await self._changed.wait()
            except TimeoutError:
                return False
        return True

    @contextlib.contextmanager
    def commit(self) -> Iterator[None]:
        """Around the last step, in which the result takes its place: too late for cancelling."""
        self._committing = True
        yield

    async def do(self, work: Coroutine[Any, Any, None]) -> None:
        """Runs the work so that `cancel` can stop it, even before it has begun."""
        self._work = asyncio.create_task(work, name=f"job {self.record.id}")
        if self._stop:
            self._work.cancel()
        await self._work

    def cancel(self) -> None:
        """Stops the work, unless its result is just being kept."""
        self._stop = True
        if self._work is not None and not self._committing:
            self._work.cancel()

    def view(self) -> JobView:
        """How it is now."""
        return JobView(self.record, self.progress, self.what)


class JobRunner:
    """Runs at most `max_jobs` jobs at once, the others wait in the order of their coming."""

    def __init__(self, store: JobStore, max_jobs: int) -> None:
        self._store = store
        self._slots = asyncio.Semaphore(max_jobs)
        self._active: dict[str, ActiveJob] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    def submit(self, record: JobRecord, work: Work) -> None:
        """Queues a job. To be called in the event loop."""
        job = ActiveJob(record)
        self._active[record.id] = job
        task = asyncio.create_task(self._run(job, work))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def view(self, job_id: str) -> JobView:
        """A job, active or ended.

        Raises:
            NotFound: there is none.
        """
        job = self._active.get(job_id)
        return job.view() if job is not None else _ended(self._store.get(job_id))

    def counts(self) -> tuple[int, int]:
        """How many jobs run and how many wait."""
        running = sum(j.record.status is Status.RUNNING for j in self._active.values())
        return running, len(self._active) - running

    async def watch(self, job_id: str, heartbeat_s: float) -> AsyncIterator[JobView | None]:
        """The job at once, after every change, and at its end; None after a silence.

        Raises:
            NotFound: there is none.
        """
        job = self._active.get(job_id)
        while job is not None and not job.record.status.ended:
            seen = job.changes
            yield job.view()
            while not await job.wait(seen, heartbeat_s):
                yield None
        yield job.view() if job is not None else await asyncio.to_thread(self.view, job_id)

    async def cancel(self, job_id: str) -> JobView:
        """Stops a job and waits until it is over; one that has ended stays as it is.

        Raises:
            NotFound: there is none.
        """
        job = self._active.get(job_id)
        if job is None:
            return await asyncio.to_thread(self.view, job_id)
        job.cancel_requested = True
        job.cancel()
        await job.over.wait()
        return job.view()

    async def close(self) -> None:
        """Stops every job; they end as failed, because the server stops."""
        for job in self._active.values():
            job.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def _run(self, job: ActiveJob, work: Work) -> None:
        try:
            status, error = await self._outcome(job, work)
            await asyncio.to_thread(work.ended, status, error)
            job.record = await asyncio.to_thread(self._store.end, job.record, status, error)
            job.progress = 1.0 if status is Status.DONE else job.progress
        except Exception:
            logger.exception("the end of job %s could not be stored", job.record.id)
            job.record = replace(job.record, status=Status.FAILED, error=INTERNAL)
        finally:
            self._active.pop(job.record.id, None)
            job.over.set()
            job.changed()

    async def _outcome(self, job: ActiveJob, work: Work) -> tuple[Status, str | None]:
        try:
            await job.do(self._do(job, work))
        except asyncio.CancelledError:
            if job.cancel_requested:
                return Status.CANCELLED, None
            return Status.FAILED, STOPPED
        except EchoRoomsError as error:
            return Status.FAILED, str(error)
        except Exception:
            logger.exception("job %s failed", job.record.id)
            return Status.FAILED, INTERNAL
        return Status.DONE, None

    async def _do(self, job: ActiveJob, work: Work) -> None:
        async with self._slots:
            job.record = await asyncio.to_thread(self._store.start, job.record)
            job.report(0.0, "starting")
            await work.run(job)


def _ended(record: JobRecord) -> JobView:
    done = record.status is Status.DONE
    return JobView(record, 1.0 if done else 0.0, "")
