"""The server's end of a worker process."""

from __future__ import annotations

import asyncio
import contextlib
import json
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.settings import worker_environment
from core.errors import EchoRoomsError, InputError, LogError, TooLargeError
from core.progress import Progress

LONGEST_ANSWER_BYTES = 1 << 24


class WorkerDiedError(EchoRoomsError):
    """A worker process ended in the middle of its task; the message says how."""


class TaskTimeoutError(EchoRoomsError):
    """A task took longer than allowed and was stopped."""


class OutOfMemoryError(TooLargeError):
    """A task needed more memory than allowed."""


class TaskFailedError(EchoRoomsError):
    """A task failed for a reason that is not the input's."""


@dataclass(frozen=True)
class TaskLimits:
    """What a task may take: seconds, and bytes of memory beyond those of an idle worker."""

    seconds: float
    memory_bytes: int


class WorkerProcess:
    """One process that runs one task at a time. Not to be used after `kill` or an error of it."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self._process = process
        self.tasks_done = 0

    @classmethod
    async def start(cls, warm: bool, module: str = "app.jobs.worker") -> WorkerProcess:
        """Starts a process; a warm one imports the heavy modules before it is asked to."""
        command = [sys.executable, "-P", "-m", module, *(["--warm"] if warm else [])]
        process = await asyncio.create_subprocess_exec(
            *command,
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            env=worker_environment(),
            limit=LONGEST_ANSWER_BYTES,
        )
        return cls(process)

    @property
    def alive(self) -> bool:
        """Whether the process still runs."""
        return self._process.returncode is None

    @property
    def pid(self) -> int:
        """The process id."""
        return self._process.pid

    async def run(
        self, task: str, arguments: dict[str, Any], limits: TaskLimits, progress: Progress
    ) -> dict[str, Any]:
        """The result of a task.

        Raises:
            InputError: what the task was given is wrong (LogError and TooLargeError included).
            TaskTimeoutError, TaskFailedError, WorkerDiedError: it did not end well.
        """
        request = {"task": task, "arguments": arguments, "memory_bytes": limits.memory_bytes}
        try:
            async with asyncio.timeout(limits.seconds):
                answer = await self._converse(request, progress)
        except TimeoutError as error:
            raise TaskTimeoutError(
                f"stopped: it took longer than the {limits.seconds:g} s allowed"
            ) from error
        self.tasks_done += 1
        if "result" in answer:
            result: dict[str, Any] = answer["result"]
            return result
        raise _error_of(answer)

    async def kill(self) -> None:
        """Ends the process at once and waits until it is gone."""
        with contextlib.suppress(ProcessLookupError):
            self._process.kill()
        await self._process.wait()

    async def _converse(self, request: dict[str, Any], progress: Progress) -> dict[str, Any]:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        with contextlib.suppress(ConnectionError):
            self._process.stdin.write((json.dumps(request) + "\n").encode())
            await self._process.stdin.drain()
        while line := await self._process.stdout.readline():
            answer: dict[str, Any] = json.loads(line)
            if "progress" not in answer:
                return answer
            progress(answer["progress"], answer["what"])
        raise WorkerDiedError(_death(await self._process.wait()))


def _death(status: int) -> str:
    """Why a process that left without an answer did so, in words."""
    if status >= 0:
        return f"the worker process ended unexpectedly (exit status {status})"
    try:
        name = signal.Signals(-status).name
    except ValueError:
        name = f"signal {-status}"
    if name == "SIGKILL":
        return "the worker process was killed (SIGKILL), by a person or for want of memory"
    return f"the worker process crashed ({name})"


def _error_of(answer: dict[str, Any]) -> EchoRoomsError:
    message, kind = str(answer["error"]), answer["kind"]
    makers: dict[str, Callable[[], EchoRoomsError]] = {
        "too_large": lambda: TooLargeError(message),
        "memory": lambda: OutOfMemoryError(message),
        "log": lambda: LogError(message),
        "bug": lambda: TaskFailedError(message),
    }
    error = makers.get(kind, lambda: InputError(message))()
    if isinstance(error, LogError):
        error.line = answer.get("line")
    return error
