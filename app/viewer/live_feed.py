"""Takes the events of a live session to every tab that shows it."""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from app.live.event_stream import Event, Listener
from app.live.session import LiveSession
from app.viewer.live_track import LiveTrack
from app.viewer.messages import Track
from app.viewer.tab import Tab
from app.viewer.tab_live import TabLive

logger = logging.getLogger(__name__)


class LiveFeed:
    """One session in one open view. Event loop's thread only."""

    def __init__(self, session: LiveSession, tabs: Callable[[], Iterable[Tab]]) -> None:
        """`tabs` gives the tabs that are open."""
        self.track = LiveTrack(session.recording.ring, session.record.mode == "localization")
        self._session = session
        self._tabs = tabs
        self._listener = session.events.listen()
        self._task = asyncio.create_task(self._run(), name=f"view of {session.record.id}")

    def span(self) -> Track:
        """From when to when the session can be looked at."""
        times = self.track.times
        return Track(first_t=times[0] if times else None, last_t=times[-1] if times else None)

    def close(self) -> None:
        """Hears no more."""
        self._task.cancel()
        self._session.events.leave(self._listener)

    async def _run(self) -> None:
        try:
            path = self._session.recording.path
            for t, odometry, ranges in await asyncio.to_thread(_recorded, path):
                self.track.add(t, odometry, ranges)
            self._draw(anew=True)
            while not self._take(await _all_waiting(self._listener)):
                self._draw()
            for tab in self._tabs():
                tab.live_ended()
        except Exception:
            logger.exception("the live view of %s is not drawn any more", self._session.record.id)

    def _take(self, events: list[Event]) -> bool:
        """Keeps what events tell; True when the session has ended."""
        for event in events:
            match event["type"]:
                case "pose":
                    self.track.add(event["t"], event["pose"], event["ranges"])
                case "taken_in":
                    self.track.correct(event["t"], event["frame"])
                case "belief":
                    self._believe(event)
                case "map":
                    for tab, live in self._shown():
                        live.mapped(tab.scene)
                case "ended":
                    return True
        return False

    def _believe(self, event: Event) -> None:
        self.track.believe(event)
        for tab, live in self._shown():
            live.believed(tab.scene)

    def _draw(self, anew: bool = False) -> None:
        for tab, live in self._shown():
            live.moved(tab.scene, anew)

    def _shown(self) -> list[tuple[Tab, TabLive]]:
        return [(tab, tab.live) for tab in self._tabs() if tab.live is not None]


async def _all_waiting(listener: Listener) -> list[Event]:
    """The next event and what else waits: a view that is late draws only the last of it."""
    events = [await listener.take()]
    while (more := listener.take_now()) is not None:
        events.append(more)
    return events


def _recorded(path: Path) -> list[tuple[float, list[float], list[float | None]]]:
    """Time, odometry and ranges of the whole lines of a recording. Reads a file: in a thread."""
    found = []
    with path.open("rb") as file:
        file.readline()
        for line in file:
            if line.endswith(b"\n"):
                record: dict[str, Any] = json.loads(line)
                found.append((record["t"], record["odom"], record["ranges"]))
    return found
