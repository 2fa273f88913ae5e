"""All simulated robots of a server: a few at a time, none for long without anybody watching."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable
from dataclasses import dataclass

from app.errors import Conflict, NotFound, Problem, Unprocessable
from app.live.hub import LiveHub
from app.live.session import LiveStatus
from app.robots.order import Command, RobotOrder
from app.robots.robot import Robot, RobotGoneError
from app.storage.data_folder import new_id

logger = logging.getLogger(__name__)
NO_ADDRESS = "this server has no address of its own: start it with `echorooms serve`"


@dataclass(frozen=True)
class FleetConfig:
    """Limits, and seconds."""

    most_robots: int = 4
    """Each takes a process of about 150 MB."""
    most_remembered: int = 20
    idle_after: float = 900.0
    """A robot that nobody has watched or told anything for so long is stopped."""
    look_every: float = 10.0


class RobotFleet:
    """Makes, commands and ends robots. Event loop's thread only."""

    def __init__(
        self,
        live: LiveHub,
        address: Callable[[], str | None],
        config: FleetConfig | None = None,
    ) -> None:
        """`address` gives the URL at which the server reaches itself."""
        self._live = live
        self._address = address
        self._config = config or FleetConfig()
        self._robots: dict[str, Robot] = {}
        self._starting = 0
        self._watch = asyncio.create_task(self._watch_forever(), name="robots")

    async def recover(self) -> None:
        """Finishes sessions whose simulated robots ended with an earlier server."""
        for record in self._live.records():
            if record.status is LiveStatus.RUNNING and self._live.session(record.id).simulated:
                await self._live.finish(record.id)

    async def create(self, order: RobotOrder) -> Robot:
        """A robot that drives.

        Raises:
            Conflict: there are too many already, or the server has no address.
            Unprocessable: it does not fit into the home, or cannot begin its session.
        """
        url = self._address()
        if url is None:
            raise Conflict(NO_ADDRESS)
        driving = sum(robot.ended is None for robot in self._robots.values()) + self._starting
        if driving >= self._config.most_robots:
            drive = "robot drives" if driving == 1 else "robots drive"
            raise Conflict(f"{driving} {drive} already, as many as may; stop one first")
        self._starting += 1
        try:
            robot = await _started(order, url)
        finally:
            self._starting -= 1
        if robot.ended is not None:
            raise Unprocessable(robot.ended)
        self._robots[robot.id] = robot
        self._forget_some()
        return robot

    def robots(self) -> list[Robot]:
        """All that drive, and the last that did, the newest first."""
        return sorted(self._robots.values(), key=lambda robot: -robot.created)

    def robot(self, robot_id: str) -> Robot:
        """One robot; to be asked for keeps it awake.

        Raises:
            NotFound: there is none of that id.
        """
        if robot_id not in self._robots:
            raise NotFound("simulated robot", robot_id)
        robot = self._robots[robot_id]
        robot.used = time.monotonic()
        return robot

    async def tell(self, robot_id: str, command: Command) -> Robot:
        """Tells a robot something.

        Raises:
            NotFound, Conflict: there is none, or it drives no more.
            InputError: it cannot do that.
        """
        robot = self.robot(robot_id)
        try:
            await robot.tell(command)
        except RobotGoneError as error:
            raise Conflict(str(error)) from error
        return robot

    async def remove(self, robot_id: str) -> None:
        """Stops a robot and finishes its session: an ordinary log with its model is left.

        Raises:
            NotFound: there is none of that id.
        """
        robot = self.robot(robot_id)
        del self._robots[robot_id]
        await self._end(robot)

    async def close(self) -> None:
        """Stops every robot; their sessions are finished at the next start."""
        self._watch.cancel()
        await asyncio.wait([self._watch])
        await asyncio.gather(*(robot.stop() for robot in self._robots.values()))

    async def _end(self, robot: Robot) -> None:
        await robot.stop()
        if robot.session_id is None:
            return
        try:
            await self._live.finish(robot.session_id)
        except Problem as problem:
            logger.debug("the session of robot %s: %s", robot.id, problem.detail)

    async def _watch_forever(self) -> None:
        while True:
            await asyncio.sleep(self._config.look_every)
            for robot in self.robots():
                if robot.ended is None and self._is_watched(robot):
                    robot.used = time.monotonic()
                elif robot.ended is None and self._is_idle(robot):
                    logger.info("robot %s is stopped: nobody watches", robot.id)
                    await self._end(robot)

    def _is_watched(self, robot: Robot) -> bool:
        try:
            return (
                robot.session_id is not None and self._live.session(robot.session_id).events.heard
            )
        except Problem:
            return False

    def _is_idle(self, robot: Robot) -> bool:
        return time.monotonic() - robot.used > self._config.idle_after

    def _forget_some(self) -> None:
        ended = [robot for robot in self.robots() if robot.ended is not None]
        for robot in ended[self._config.most_remembered :]:
            del self._robots[robot.id]


async def _started(order: RobotOrder, url: str) -> Robot:
    """A robot that has said how it stands, or has ended."""
    robot = await Robot.start(new_id(), order, url)
    try:
        await robot.ready()
    except asyncio.CancelledError:
        await asyncio.shield(robot.stop())
        raise
    return robot
