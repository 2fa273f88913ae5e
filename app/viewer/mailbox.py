"""Messages waiting for a page: bounded, the oldest dropped, so that a stalled page costs nothing."""

from __future__ import annotations

import asyncio
from collections import deque

from app.viewer.messages import ToPage

_MOST_WAITING = 64


class Mailbox:
    """A queue of one event socket. For the event loop's thread only."""

    def __init__(self) -> None:
        self._waiting: deque[ToPage] = deque(maxlen=_MOST_WAITING)
        self._news = asyncio.Event()
        self._closed = False

    def put(self, message: ToPage) -> None:
        """Adds a message; the oldest goes when there are too many."""
        self._waiting.append(message)
        self._news.set()

    def close(self) -> None:
        """Ends `take` once everything has been taken."""
        self._closed = True
        self._news.set()

    async def take(self) -> ToPage | None:
        """The next message, or None when the mailbox is closed and empty."""
        while not self._waiting:
            if self._closed:
                return None
            self._news.clear()
            await self._news.wait()
        return self._waiting.popleft()
