"""A robot's radio: scans wait here and are sent in a thread, so that a slow network stops no wheel."""

from __future__ import annotations

import threading
from typing import Any

from app.live.robot_client import RobotClient
from core.errors import EchoRoomsError


class Uplink:
    """Sends scans over a client, in order, until they are confirmed.

    Attributes:
        trouble: why nothing is sent any more, if so.
    """

    def __init__(self, client: RobotClient) -> None:
        self.client = client
        self.trouble: str | None = None
        self._waiting: list[dict[str, Any]] = []
        self._changed = threading.Condition()
        self._closed = False
        self._thread = threading.Thread(target=self._send_all, name="uplink", daemon=True)
        self._thread.start()

    @property
    def waiting(self) -> int:
        """Scans that are not confirmed yet."""
        with self._changed:
            return len(self._waiting)

    def put(self, record: dict[str, Any]) -> None:
        """Takes a scan to be sent."""
        with self._changed:
            self._waiting.append(record)
            self._changed.notify()

    def close(self) -> None:
        """Returns when everything is confirmed, or nothing can be any more."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        self._thread.join()

    def _send_all(self) -> None:
        while batch := self._next():
            try:
                self.client.send(batch)
            except EchoRoomsError as error:
                self.trouble = str(error)
                return
            with self._changed:
                del self._waiting[: len(batch)]

    def _next(self) -> list[dict[str, Any]]:
        """What waits now; nothing once everything is sent and the uplink is closed."""
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or self._closed)
            return list(self._waiting)
