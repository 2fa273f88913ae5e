"""Everything that a running server holds, opened and closed together."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator
from dataclasses import dataclass

from app.events import ModelEvents
from app.jobs.runner import STOPPED, JobRunner
from app.jobs.worker_pool import WorkerPool
from app.jobs.worker_process import TaskLimits
from app.settings import MEBIBYTE, Settings
from app.storage.calibration_store import CalibrationStore
from app.storage.data_folder import DataFolder
from app.storage.database import Database
from app.storage.job_store import JobStore
from app.storage.localization_store import LocalizationStore
from app.storage.log_store import LogStore
from app.storage.model_store import ModelStore
from app.storage.sample_store import SampleStore


@dataclass(frozen=True)
class Services:
    """What routes, jobs and live sessions work with."""

    settings: Settings
    folder: DataFolder
    database: Database
    logs: LogStore
    models: ModelStore
    localizations: LocalizationStore
    calibrations: CalibrationStore
    jobs: JobStore
    samples: SampleStore
    runner: JobRunner
    pool: WorkerPool
    events: ModelEvents
    reading_slots: asyncio.Semaphore

    @property
    def reading_limits(self) -> TaskLimits:
        """What reading an upload may take."""
        return TaskLimits(self.settings.upload_timeout_s, self.settings.upload_memory_mb * MEBIBYTE)

    @property
    def job_limits(self) -> TaskLimits:
        """What a job may take."""
        return TaskLimits(self.settings.job_timeout_s, self.settings.job_memory_mb * MEBIBYTE)


@contextlib.asynccontextmanager
async def open_services(settings: Settings, events: ModelEvents) -> AsyncIterator[Services]:
    """Opens the data folder, tidies up after a crash, and closes everything at the end.

    Raises:
        InputError: the data folder cannot be used.
    """
    folder = DataFolder(settings.data)
    folder.open()
    database = Database(folder.database)
    job_store = JobStore(database)
    services = Services(
        settings,
        folder,
        database,
        LogStore(database, folder),
        ModelStore(database, folder, events),
        LocalizationStore(database, folder),
        CalibrationStore(database),
        job_store,
        SampleStore(database),
        JobRunner(job_store, settings.max_jobs),
        WorkerPool(settings.warm_workers),
        events,
        asyncio.Semaphore(settings.max_jobs),
    )
    services.jobs.fail_unended(STOPPED)
    services.logs.remove_orphans()
    services.models.recover(STOPPED)
    services.localizations.recover(STOPPED)
    try:
        await services.pool.warm_up()
        yield services
    finally:
        await services.runner.close()
        await services.pool.close()
        database.close()
        folder.close()
