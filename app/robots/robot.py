"""The server's end of one simulated robot's process."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import logging
import sys
import time
from typing import Any

from app.robots.order import Command, RobotOrder
from app.settings import worker_environment
from core.errors import EchoRoomsError, InputError

logger = logging.getLogger(__name__)
ANSWER_S = 10.0
LEAVE_S = 2.0
"""Seconds for a process to answer, and to leave by itself."""
LONGEST_LINE = 1 << 20


class RobotGoneError(EchoRoomsError):
    """The robot's process has ended."""


class Robot:
    """A robot that drives, or has driven. Event loop's thread only.

    Attributes:
        status: what its process said last; empty until it says something.
        ended: why it drives no more; None while it does.
        used: when somebody last asked or told it something (monotonic seconds).
    """

    def __init__(
        self, robot_id: str, order: RobotOrder, process: asyncio.subprocess.Process
    ) -> None:
        self.id = robot_id
        self.order = order
        self.created = time.time()
        self.status: dict[str, Any] = {}
        self.ended: str | None = None
        self.used = time.monotonic()
        self._process = process
        self._numbers = itertools.count()
        self._answers: dict[int, asyncio.Future[str | None]] = {}
        self._heard = asyncio.Event()
        self._reading = asyncio.create_task(self._read(), name=f"robot {robot_id}")

    @classmethod
    async def start(cls, robot_id: str, order: RobotOrder, url: str) -> Robot:
        """Starts the process of a robot that feeds the server at an address."""
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-P",
            "-m",
            "app.robots.process",
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            env=worker_environment(),
            limit=LONGEST_LINE,
        )
        robot = cls(robot_id, order, process)
        await robot._write({"url": url, "order": order.model_dump()})
        return robot

    @property
    def session_id(self) -> str | None:
        """The live session that it feeds."""
        return self.status.get("session_id")

    async def ready(self) -> None:
        """Returns when it has said how it stands, or has ended."""
        await self._heard.wait()

    async def tell(self, command: Command) -> None:
        """Returns when the robot has understood.

        Raises:
            InputError: it cannot do that.
            RobotGoneError: it drives no more, or does not answer.
        """
        if self.ended is not None:
            raise RobotGoneError(f"the robot drives no more: {self.ended}")
        number = next(self._numbers)
        answer = self._answers[number] = asyncio.get_running_loop().create_future()
        await self._write({"number": number, "command": command.model_dump()})
        try:
            async with asyncio.timeout(ANSWER_S):
                error = await answer
        except TimeoutError as late:
            raise RobotGoneError("the robot does not answer") from late
        finally:
            self._answers.pop(number, None)
        if error is not None:
            raise InputError(error)

    async def stop(self) -> None:
        """Ends the process: by its own will, else by force."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        try:
            async with asyncio.timeout(LEAVE_S):
                await self._process.wait()
        except TimeoutError:
            with contextlib.suppress(ProcessLookupError):
                self._process.kill()
        await asyncio.wait([self._reading])

    async def _write(self, message: dict[str, Any]) -> None:
        assert self._process.stdin is not None
        with contextlib.suppress(ConnectionError):
            self._process.stdin.write((json.dumps(message) + "\n").encode())
            await self._process.stdin.drain()

    async def _read(self) -> None:
        assert self._process.stdout is not None
        why = None
        while line := await self._process.stdout.readline():
            message: dict[str, Any] = json.loads(line)
            if "status" in message:
                self.status |= message["status"]
                self._heard.set()
            elif "answer" in message:
                answer = self._answers.get(message["answer"])
                if answer is not None and not answer.done():
                    answer.set_result(message["error"])
            else:
                why = message["ended"]
        code = await self._process.wait()
        self.ended = why or ("it was stopped" if code == 0 else f"its process ended ({code})")
        for answer in self._answers.values():
            if not answer.done():
                answer.set_exception(RobotGoneError(f"the robot drives no more: {self.ended}"))
        self._heard.set()
