"""The server as a client of an MQTT broker: scans in, acknowledgements and current rooms out.

Topics below the setting `mqtt_topic` (`echorooms`), ROBOT being any name without `/`:

    ROBOT/header  native header, retained; may hold `mode` and `model_id`
    ROBOT/scans   a scan line or a list of them            ROBOT/end    ends the session
    ROBOT/ack     {"ack", "stored", "duplicates"}          ROBOT/error  what was wrong with a message
    ROBOT/room    {"room", "node", "probability", "entropy", "t"}, retained
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
from dataclasses import dataclass
from urllib.parse import unquote, urlsplit

import aiomqtt

from app.live.hub import LiveHub
from app.live.mqtt_robot import MqttRobot
from app.live.mqtt_rooms import announce_rooms
from app.settings import Settings
from core.errors import InputError

logger = logging.getLogger(__name__)
PORT, TLS_PORT = 1883, 8883
RETRY_S = (1.0, 2.0, 5.0, 10.0, 30.0)
LARGEST_MESSAGE = 4 << 20
MOST_ROBOTS = 200
INPUTS = ("header", "scans", "end")


@dataclass(frozen=True)
class Broker:
    """Where a broker is and how one logs in there."""

    host: str
    port: int
    tls: bool
    username: str | None
    password: str | None

    @classmethod
    def of(cls, url: str) -> Broker:
        """The broker that a setting names.

        Raises:
            InputError: it is no address of a broker.
        """
        try:
            parts = urlsplit(url)
            tls = {"mqtt": False, "mqtts": True}[parts.scheme]
            port = parts.port or (TLS_PORT if tls else PORT)
        except (KeyError, ValueError) as error:
            raise InputError(
                f"mqtt_url {url!r} is no address such as mqtt://broker.example:1883"
            ) from error
        name, word = parts.username, parts.password
        return cls(
            parts.hostname or "localhost",
            port,
            tls,
            unquote(name) if name else None,
            unquote(word) if word else None,
        )

    def client(self) -> aiomqtt.Client:
        """A client that is not connected yet."""
        return aiomqtt.Client(
            self.host,
            self.port,
            username=self.username,
            password=self.password,
            tls_params=aiomqtt.TLSParameters() if self.tls else None,
        )


async def follow_broker(broker: Broker, live: LiveHub, settings: Settings) -> None:
    """Takes scans from the broker until it is cancelled; connects again whenever it is lost."""
    tries = 0
    while True:
        try:
            async with broker.client() as client:
                logger.info("connected to the MQTT broker")
                tries = 0
                await _serve(client, live, settings)
        except* aiomqtt.MqttError as errors:
            pause = RETRY_S[min(tries, len(RETRY_S) - 1)]
            reason = errors.exceptions[0]
            logger.warning("no MQTT broker (%s); trying again in %g s", reason, pause)
            tries += 1
            await asyncio.sleep(pause)


async def _serve(client: aiomqtt.Client, live: LiveHub, settings: Settings) -> None:
    topic = settings.mqtt_topic
    for kind in INPUTS:
        await client.subscribe(f"{topic}/+/{kind}", qos=1)
    async with asyncio.TaskGroup() as tasks:
        rooms = tasks.create_task(announce_rooms(client, live, settings))
        try:
            await _dispatch(client, live, topic, tasks)
        finally:
            rooms.cancel()


async def _dispatch(
    client: aiomqtt.Client, live: LiveHub, topic: str, tasks: asyncio.TaskGroup
) -> None:
    """Hands every message to its robot, each of which works at its own pace."""
    robots: dict[str, tuple[MqttRobot, asyncio.Task[None]]] = {}
    try:
        async for message in client.messages:
            name, _, kind = str(message.topic)[len(topic) + 1 :].rpartition("/")
            payload = message.payload if isinstance(message.payload, bytes) else b""
            if name not in robots:
                if len(robots) >= MOST_ROBOTS:
                    refusal = json.dumps({"error": "there are too many robots"})
                    await client.publish(f"{topic}/{name}/error", refusal)
                    continue
                robot = MqttRobot(client, live, f"{topic}/{name}")
                robots[name] = robot, tasks.create_task(robot.run(), name=f"MQTT robot {name}")
            robot = robots[name][0]
            if len(payload) > LARGEST_MESSAGE:
                await robot.complain(f"a message has at most {LARGEST_MESSAGE >> 20} MiB")
            elif not robot.hand(kind, payload):
                await robot.complain("messages come faster than they can be stored; send it again")
    finally:
        for _, task in robots.values():
            task.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await asyncio.gather(*(task for _, task in robots.values()), return_exceptions=True)
