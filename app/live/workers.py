"""The worker processes of live sessions: each session has one, and gets another when that is lost."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator
from typing import Any

from app.jobs.worker_process import TaskLimits, WorkerDiedError, WorkerProcess
from core.progress import no_progress

MODULE = "app.live.worker"
LOOK_S = 0.01
"""Between two looks of what can wait whether anything urgent is left."""


class Turns:
    """Who may use a process: scans first, models when no scan waits."""

    def __init__(self) -> None:
        self._lock = asyncio.Lock()
        self._urgent = 0

    @contextlib.asynccontextmanager
    async def turn(self, urgent: bool) -> AsyncIterator[None]:
        """The process is one's own inside."""
        self._urgent += urgent
        try:
            await self._lock.acquire()
        finally:
            self._urgent -= urgent
        while not urgent and self._urgent:
            self._lock.release()
            await asyncio.sleep(LOOK_S)
            await self._lock.acquire()
        try:
            yield
        finally:
            self._lock.release()


class LiveWorkers:
    """At most so many processes, started when they are needed. Event loop's thread only."""

    def __init__(self, most: int, limits: TaskLimits) -> None:
        self._limits = limits
        self._processes: list[WorkerProcess | None] = [None] * most
        self._turns = [Turns() for _ in range(most)]
        self._place: dict[str, int] = {}

    async def run(
        self, session_id: str, task: str, arguments: dict[str, Any], urgent: bool = True
    ) -> dict[str, Any]:
        """The result of a task of a session; one that is not urgent lets all others go first.

        Raises:
            EchoRoomsError: the task failed or its process was lost; the next one starts another.
        """
        place = self._place.setdefault(session_id, self._emptiest())
        async with self._turns[place].turn(urgent):
            process = self._processes[place]
            if process is None or not process.alive:
                process = await WorkerProcess.start(warm=False, module=MODULE)
                self._processes[place] = process
            try:
                given = {"session": session_id} | arguments
                return await process.run(task, given, self._limits, no_progress)
            except (asyncio.CancelledError, TimeoutError, WorkerDiedError):
                self._processes[place] = None
                await process.kill()
                raise

    async def forget(self, session_id: str) -> None:
        """The session has ended."""
        if self._place.get(session_id) is not None:
            await self.run(session_id, "forget", {})
            del self._place[session_id]

    async def close(self) -> None:
        """Ends all processes."""
        for process in self._processes:
            if process is not None:
                await process.kill()

    def _emptiest(self) -> int:
        """The place with the fewest sessions."""
        sessions = list(self._place.values())
        return min(range(len(self._processes)), key=sessions.count)
