"""Events of a session for everybody who listens; a slow listener loses the oldest, not the server."""

from __future__ import annotations

import asyncio
from collections import deque
from typing import Any

MOST_WAITING = 64
Event = dict[str, Any]


class Listener:
    """The events that one client has yet to get."""

    def __init__(self) -> None:
        self._waiting: deque[Event] = deque(maxlen=MOST_WAITING)
        self._called = asyncio.Event()

    def put(self, event: Event) -> None:
        """Adds an event; the oldest goes when there are too many."""
        self._waiting.append(event)
        self._called.set()

    async def take(self) -> Event:
        """The next event."""
        while not self._waiting:
            self._called.clear()
            await self._called.wait()
        return self._waiting.popleft()

    def take_now(self) -> Event | None:
        """The next event if there is one already."""
        return self._waiting.popleft() if self._waiting else None


class EventStream:
    """Gives every event to every listener. Event loop's thread only."""

    def __init__(self) -> None:
        self._listeners: set[Listener] = set()

    @property
    def heard(self) -> bool:
        """Whether anybody listens."""
        return bool(self._listeners)

    def listen(self) -> Listener:
        """A new listener."""
        listener = Listener()
        self._listeners.add(listener)
        return listener

    def leave(self, listener: Listener) -> None:
        """The listener has gone."""
        self._listeners.discard(listener)

    def send(self, event: Event) -> None:
        """Tells everybody."""
        for listener in self._listeners:
            listener.put(event)
