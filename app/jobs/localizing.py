"""Localization jobs: a worker writes the steps, the store takes them over when they are whole."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.errors import NotFound, Unprocessable
from app.jobs.runner import ActiveJob
from app.services import Services
from app.storage.localization_store import STEPS_FILE
from app.storage.records import JobRecord, LocalizationRecord, Status

KIND = "localization"


@dataclass(frozen=True)
class Localizing:
    """One localization job (a `Work`)."""

    services: Services
    record: LocalizationRecord
    model: Path
    log: Path

    async def run(self, job: ActiveJob) -> None:
        """Localizes the robot all along the log."""
        services, record = self.services, self.record
        store = services.localizations
        await asyncio.to_thread(store.set, record.id, status=Status.RUNNING.value)
        with services.folder.temporary() as temp:
            made = temp / "localization"
            made.mkdir()
            arguments = {
                "model": str(self.model),
                "log": str(self.log),
                "options": dict(record.options),
                "out": str(made / STEPS_FILE),
            }
            found = await services.pool.run("localize", arguments, services.job_limits, job.report)
            with job.commit():
                await asyncio.to_thread(store.publish, record.id, made, int(found["steps"]))

    def ended(self, status: Status, error: str | None) -> None:
        """Notes on the localization how its job ended."""
        if status is not Status.DONE:
            self.services.localizations.set(self.record.id, status=status.value, error=error)


async def localize_a_log(
    services: Services, model_id: str, log_id: str, options: Mapping[str, Any]
) -> tuple[LocalizationRecord, JobRecord]:
    """A new localization, queued.

    Raises:
        Unprocessable: there is no such model or log.
        Conflict: the model is not made yet.
    """

    def begin() -> tuple[LocalizationRecord, JobRecord, Path, Path]:
        try:
            log = services.logs.get(log_id)
            folder = services.models.folder(model_id)
        except NotFound as error:
            raise Unprocessable(str(error.detail)) from error
        record = services.localizations.add(log.name, model_id, log_id, options)
        job = services.jobs.add(KIND, record.id)
        services.localizations.set(record.id, job_id=job.id)
        return record, job, folder, services.logs.native_file(log_id)

    record, job, folder, log = await asyncio.to_thread(begin)
    services.runner.submit(job, Localizing(services, record, folder, log))
    return record, job
