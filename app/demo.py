"""The demo: sample logs that come with the product, loaded and modelled at the first start."""

from __future__ import annotations

import asyncio
import logging
import shutil
from pathlib import Path
from typing import Any

from app.jobs.modelling import model_a_log
from app.jobs.reading import keep_log
from app.services import Services
from app.settings import PACKAGE_ROOT

SAMPLE_FOLDER = PACKAGE_ROOT / "sample_logs"
SAMPLE_PATTERN = "*.jsonl.gz"
NOT_FOR_MAPPING = "localization"
"""A sample with this in its name is a drive through a known home: it gets no model of its own."""
SAMPLE_OPTIONS: dict[str, Any] = {"mode": "offline", "regions": 10}
"""Ten regions, as in the paper's own figure of its home (Sect. 5)."""
logger = logging.getLogger(__name__)


async def load_samples(services: Services, folder: Path = SAMPLE_FOLDER) -> None:
    """Loads every sample that was never loaded before and queues a model for it."""
    loaded = await asyncio.to_thread(services.samples.loaded)
    for sample in sorted(folder.glob(SAMPLE_PATTERN)):
        if sample.name not in loaded:
            try:
                await _load(services, sample)
            except Exception:
                # One sample that cannot be loaded must not keep the others away.
                logger.exception("the sample %s cannot be loaded", sample.name)


async def _load(services: Services, sample: Path) -> None:
    with services.folder.temporary() as temp:
        upload = Path(await asyncio.to_thread(shutil.copy, sample, temp))
        log = await keep_log(services, upload, None, temp)
    await asyncio.to_thread(services.samples.add, sample.name)
    if NOT_FOR_MAPPING not in sample.name:
        await model_a_log(services, log.id, None, SAMPLE_OPTIONS)
