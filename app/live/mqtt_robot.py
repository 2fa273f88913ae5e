"""One robot that speaks MQTT: its session goes the way of every other one."""

from __future__ import annotations

import asyncio
import json
import logging
from typing import Any

import aiomqtt
from pydantic import BaseModel, Field, ValidationError

from app.errors import Problem
from app.live.hub import LiveHub, Mode
from app.live.session import MODEL_ID, LiveStatus
from core.errors import EchoRoomsError, InputError
from core.log_readers.safe_yaml import describe

logger = logging.getLogger(__name__)
MOST_WAITING = 256


class _Beginning(BaseModel):
    """What a header says beside being one."""

    mode: Mode = "mapping"
    model_id: str | None = Field(None, pattern=MODEL_ID)


class MqttRobot:
    """Takes the messages of one robot in order and answers them."""

    def __init__(self, client: aiomqtt.Client, live: LiveHub, topic: str) -> None:
        self._client = client
        self._live = live
        self._topic = topic
        self._session: str | None = None
        self._waiting: asyncio.Queue[tuple[str, bytes]] = asyncio.Queue(MOST_WAITING)

    def hand(self, kind: str, payload: bytes) -> bool:
        """Takes a message (`header`, `scans` or `end`) to be worked on; False when it is too much."""
        try:
            self._waiting.put_nowait((kind, payload))
        except asyncio.QueueFull:
            return False
        return True

    async def complain(self, reason: str) -> None:
        """Tells the robot what is wrong."""
        await self._client.publish(f"{self._topic}/error", json.dumps({"error": reason}))

    async def run(self) -> None:
        """Works until it is cancelled."""
        while True:
            kind, payload = await self._waiting.get()
            try:
                await self._take(kind, payload)
            except (EchoRoomsError, OSError) as error:
                await self.complain(str(error))
            except Problem as error:
                await self.complain(str(error.detail))
            except aiomqtt.MqttError:
                raise
            except Exception:
                logger.exception("a message to %s/%s failed", self._topic, kind)
                await self.complain("something went wrong in the server; its own log says more")

    async def _take(self, kind: str, payload: bytes) -> None:
        if kind == "end":
            if self._session is not None:
                await self._live.finish(self._session)
                self._session = None
                await self._client.publish(f"{self._topic}/header", b"", qos=1, retain=True)
            return
        if kind == "header" and not payload:
            return
        content = _parsed(payload)
        if kind == "header":
            self._session = await self._session_of(content)
            standing = self._live.record(self._session)
            answer: dict[str, Any] = {"ack": standing.last_t, "stored": standing.stored}
        else:
            if self._session is None:
                raise InputError(
                    "send the header first, retained, to the topic that ends in header"
                )
            taken = await self._live.take(self._session, content)
            answer = {"ack": taken.ack, "stored": taken.stored, "duplicates": taken.duplicates}
        await self._client.publish(f"{self._topic}/ack", json.dumps(answer), qos=1)

    async def _session_of(self, content: Any) -> str:
        """The session that goes on with this header, or a new one.

        A retained header comes again with every connection; it does not begin another session.
        """
        try:
            wanted = _Beginning.model_validate(content)
        except ValidationError as error:
            raise InputError(f"header: {describe(error)}") from error
        header = {k: v for k, v in content.items() if k not in ("mode", "model_id")}
        for record in self._live.records():
            session = self._live.running(record.id)
            if session is None or record.origin != self._topic:
                continue
            place = wanted.model_id if wanted.mode == "localization" else record.model_id
            same = (record.mode, record.model_id) == (wanted.mode, place)
            if same and session.recording.header == header:
                return record.id
            if record.status is LiveStatus.RUNNING:
                await self._live.finish(record.id)
        made = await self._live.create(wanted.mode, header, wanted.model_id, self._topic)
        return made.id


def _parsed(payload: bytes) -> Any:
    try:
        return json.loads(payload)
    except (ValueError, RecursionError) as error:
        raise InputError(f"not JSON ({str(error)[:100]})") from error
