"""Worker processes: a few kept warm, the rest started when needed, none trusted for too long."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator
from typing import Any

from app.jobs.worker_process import OutOfMemoryError, TaskLimits, WorkerProcess
from core.errors import InputError
from core.progress import Progress, no_progress

TASKS_PER_WORKER = 20
"""A process is replaced after so many tasks, so that nothing that leaks adds up."""


class WorkerPool:
    """Runs tasks, each alone in its process.

    A process that ended its task well may serve another; one that failed, timed out or was cancelled
    in the middle is killed. Importing the scientific modules takes a process one to two seconds of
    processor time, which is why idle ones are kept.
    """

    def __init__(self, warm_workers: int) -> None:
        self._keep = warm_workers
        self._idle: list[WorkerProcess] = []
        self._busy: set[WorkerProcess] = set()
        self._closed = False

    async def warm_up(self) -> None:
        """Starts the idle processes."""
        while len(self._idle) < self._keep and not self._closed:
            self._idle.append(await WorkerProcess.start(warm=True))

    async def run(
        self,
        task: str,
        arguments: dict[str, Any],
        limits: TaskLimits,
        progress: Progress = no_progress,
    ) -> dict[str, Any]:
        """The result of a task, run in a process of its own; cancelling kills the process."""
        async with self._worker() as worker:
            return await worker.run(task, arguments, limits, progress)

    async def close(self) -> None:
        """Kills every process."""
        self._closed = True
        await asyncio.gather(*(worker.kill() for worker in (*self._idle, *self._busy)))
        self._idle.clear()

    @contextlib.asynccontextmanager
    async def _worker(self) -> AsyncIterator[WorkerProcess]:
        worker = await self._take()
        self._busy.add(worker)
        reusable = False
        try:
            yield worker
            reusable = True
        except InputError as error:
            reusable = not isinstance(error, OutOfMemoryError)
            raise
        finally:
            self._busy.discard(worker)
            await self._give_back(worker, reusable)

    async def _take(self) -> WorkerProcess:
        while self._idle:
            worker = self._idle.pop()
            if worker.alive:
                return worker
        return await WorkerProcess.start(warm=False)

    async def _give_back(self, worker: WorkerProcess, reusable: bool) -> None:
        fresh = worker.alive and worker.tasks_done < TASKS_PER_WORKER
        if reusable and fresh and not self._closed and len(self._idle) < self._keep:
            self._idle.append(worker)
            return
        await asyncio.shield(worker.kill())
        if not self._closed:
            await self.warm_up()
