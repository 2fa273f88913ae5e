"""Reading what somebody sends: while they wait, in a worker, within tight limits."""

from __future__ import annotations

from typing import Any

from app.errors import Unprocessable
from app.jobs.worker_process import TaskTimeoutError, WorkerDiedError
from app.services import Services


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
