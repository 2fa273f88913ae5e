"""Reading what somebody sends: while they wait, in a worker, within tight limits."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

from app.errors import Unprocessable
from app.jobs.worker_process import TaskTimeoutError, WorkerDiedError
from app.services import Services
from app.storage.records import LogRecord


async def keep_log(services: Services, upload: Path, ring: str | None, temp: Path) -> LogRecord:
    """Reads a log in a worker and keeps it.

    Args:
        upload: the file as it came; it is moved.
        ring: a preset's name or the text of a ring file, for formats without geometry.
        temp: a folder to prepare it in.

    Raises:
        LogError, TooLargeError, Unprocessable: it cannot be read, and why.
    """
    prepared = temp / "log"
    arguments = {"upload": str(upload), "ring": ring, "out": str(prepared)}
    summary = await read_upload(services, "read_log", arguments)
    return await asyncio.to_thread(services.logs.add, prepared, summary)


async def read_upload(services: Services, task: str, arguments: dict[str, Any]) -> dict[str, Any]:
    """The result of a reading task.

    Raises:
        InputError: what was sent is wrong (LogError with its line, TooLargeError).
        Unprocessable: reading it took too long or brought the worker down.
    """
    async with services.reading_slots:
        try:
            return await services.pool.run(task, arguments, services.reading_limits)
        except TaskTimeoutError as error:
            raise Unprocessable(
                f"reading took longer than the {services.settings.upload_timeout_s:g} s allowed; "
                "send it in smaller parts"
            ) from error
        except WorkerDiedError as error:
            raise Unprocessable(f"it cannot be read: {error}") from error
