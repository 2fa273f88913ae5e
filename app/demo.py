"""The demo: sample logs that come with the product, loaded, modelled and localized at first start, and
a simulated robot that maps a home of its own."""

from __future__ import annotations

import asyncio
import logging
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.errors import Problem
from app.jobs.localizing import localize_a_log
from app.jobs.modelling import model_a_log
from app.jobs.reading import keep_log
from app.robots.fleet import RobotFleet
from app.robots.order import RobotOrder
from app.services import Services
from app.settings import PACKAGE_ROOT
from app.storage.records import Status

SAMPLE_FOLDER = PACKAGE_ROOT / "sample_logs"
SUFFIX = ".jsonl.gz"
FOR_MAPPING = "-mapping"
"""A sample `HOME-mapping` is modelled; the others of that home are localized in its model."""
SAMPLE_OPTIONS: dict[str, Any] = {}
"""Autonomous, with every default."""
LOCALIZATION_OPTIONS: dict[str, Any] = {"method": "default"}
HEARTBEAT_S = 60.0
ROBOT = RobotOrder(home="random-17", seed=1)
"""What drives while the samples are looked at: a home that is not among them."""
logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class SampleHome:
    """A home of which a model is being made, and the logs of other drives through it."""

    model_id: str
    job_id: str
    log_ids: tuple[str, ...]


async def show_samples(services: Services, folder: Path = SAMPLE_FOLDER) -> None:
    """Loads and models the samples, and localizes in each model as soon as it is made."""
    homes = await load_samples(services, folder)
    await asyncio.gather(*(localize_samples(services, home) for home in homes))


async def send_a_robot(fleet: RobotFleet) -> None:
    """Lets a simulated robot tour and map a home."""
    try:
        await fleet.create(ROBOT)
    except Problem as problem:
        logger.warning("the demo's robot does not drive: %s", problem.detail)


async def load_samples(services: Services, folder: Path = SAMPLE_FOLDER) -> list[SampleHome]:
    """Loads every sample that was never loaded before and queues a model for a mapping drive."""
    loaded = await asyncio.to_thread(services.samples.loaded)
    logs: dict[str, str] = {}
    models: dict[str, tuple[str, str]] = {}
    for sample in sorted(folder.glob(f"*{SUFFIX}")):
        if sample.name in loaded:
            continue
        drive = sample.name.removesuffix(SUFFIX)
        try:
            logs[drive] = await _load(services, sample)
            if drive.endswith(FOR_MAPPING):
                model, job = await model_a_log(services, logs[drive], None, SAMPLE_OPTIONS)
                models[drive.removesuffix(FOR_MAPPING)] = (model.id, job.id)
        except Exception:
            # One sample that cannot be loaded must not keep the others away.
            logger.exception("the sample %s cannot be loaded", sample.name)
    return [SampleHome(*models[home], _other_drives(home, logs)) for home in models]


async def localize_samples(services: Services, home: SampleHome) -> None:
    """Queues localizations once the model is made; none if it never is or somebody deletes it."""
    status = Status.QUEUED
    async for view in services.runner.watch(home.job_id, HEARTBEAT_S):
        status = view.record.status if view is not None else status
    if status is not Status.DONE:
        return
    for log_id in home.log_ids:
        try:
            await localize_a_log(services, home.model_id, log_id, LOCALIZATION_OPTIONS)
        except Problem as problem:
            logger.warning("a sample is not localized: %s", problem.detail)


def _other_drives(home: str, logs: Mapping[str, str]) -> tuple[str, ...]:
    """The logs by name (`HOME-…`) that are to be localized in the model of a home."""
    drives = [drive for drive in logs if drive.startswith(f"{home}-")]
    return tuple(logs[drive] for drive in drives if not drive.endswith(FOR_MAPPING))


async def _load(services: Services, sample: Path) -> str:
    """Keeps a sample and remembers it; the id of its log."""
    with services.folder.temporary() as temp:
        upload = Path(await asyncio.to_thread(shutil.copy, sample, temp))
        log = await keep_log(services, upload, None, temp)
    await asyncio.to_thread(services.samples.add, sample.name)
    return log.id
