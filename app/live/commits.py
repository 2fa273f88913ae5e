"""Group commit: scans of many robots go to the disk together, a few milliseconds after they came."""

from __future__ import annotations

import asyncio
from typing import Any

from app.live.recording import Recording

GATHER_S = 0.004
"""Seconds for which scans are gathered before they are written."""

Waiting = tuple[list[dict[str, Any]], asyncio.Future[None]]


class GroupCommit:
    """Writes what sessions hand in. Lives in the event loop; the disk is waited for in a thread."""

    def __init__(self) -> None:
        self._waiting: dict[Recording, list[Waiting]] = {}
        self._called = asyncio.Event()
        self._task = asyncio.create_task(self._write_forever(), name="live commits")

    async def store(self, recording: Recording, records: list[dict[str, Any]]) -> None:
        """Returns when the scans are safe.

        Raises:
            OSError: they could not be written.
        """
        done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._waiting.setdefault(recording, []).append((records, done))
        self._called.set()
        await asyncio.shield(done)

    async def close(self) -> None:
        """Writes what waits, then stops."""
        self._task.cancel()
        await asyncio.wait([self._task])
        await self._write()

    async def _write_forever(self) -> None:
        while True:
            await self._called.wait()
            await asyncio.sleep(GATHER_S)
            self._called.clear()
            await asyncio.shield(self._write())

    async def _write(self) -> None:
        batch, self._waiting = self._waiting, {}
        if not batch:
            return
        errors = await asyncio.to_thread(_append_all, batch)
        for recording, handed_in in batch.items():
            for _, done in handed_in:
                if done.cancelled():
                    continue
                if error := errors.get(recording):
                    done.set_exception(error)
                else:
                    done.set_result(None)


def _append_all(batch: dict[Recording, list[Waiting]]) -> dict[Recording, OSError]:
    errors: dict[Recording, OSError] = {}
    for recording, handed_in in batch.items():
        try:
            recording.append([record for records, _ in handed_in for record in records])
        except OSError as error:
            errors[recording] = error
    return errors
