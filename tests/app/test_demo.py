"""The sample logs of the demo."""

from __future__ import annotations

import asyncio
import gzip
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from app.demo import load_samples, show_samples
from app.events import ModelEvents
from app.services import open_services
from app.settings import PACKAGE_ROOT, Settings
from app.storage.search import Sorting


@pytest.fixture
def samples(tmp_path: Path, make_log: Callable[..., bytes]) -> Path:
    """Two drives through homes, one for localization and one broken file."""
    folder = tmp_path / "samples"
    folder.mkdir()
    for name in ("flat-mapping", "house-mapping", "flat-localization"):
        (folder / f"{name}.jsonl.gz").write_bytes(gzip.compress(make_log(scans=20, name=name)))
    (folder / "broken.jsonl.gz").write_bytes(b"broken")
    return folder


def load(
    settings: Settings, folder: Path, delete: str | None = None
) -> tuple[list[str], list[str]]:
    """Loads the samples once; the names of all logs and of all models afterwards."""

    async def main() -> tuple[list[str], list[str]]:
        async with open_services(settings, ModelEvents()) as services:
            await load_samples(services, folder)
            by_name = Sorting.of("name")
            for log in services.logs.search(delete or "", by_name) if delete else ():
                services.logs.delete(log.id)
            logs = [log.name for log in services.logs.search("", by_name)]
            return logs, [model.name for model in services.models.search("", by_name)]

    return asyncio.run(main())


def test_samples_are_loaded_once_and_the_mapping_drives_modelled(
    settings: Settings, samples: Path
) -> None:
    logs, models = load(settings, samples)
    assert logs == ["flat-localization", "flat-mapping", "house-mapping"]
    assert models == ["flat-mapping", "house-mapping"]
    assert load(settings, samples) == (logs, models)


def test_a_sample_that_was_deleted_does_not_come_back(settings: Settings, samples: Path) -> None:
    load(settings, samples, delete="localization")
    logs, _ = load(settings, samples)
    assert logs == ["flat-mapping", "house-mapping"]


def test_other_drives_through_a_home_are_localized_once_its_model_is_made(
    settings: Settings, tmp_path: Path, make_log: Callable[..., bytes]
) -> None:
    for name in ("flat-mapping", "flat-changed", "house-localization"):
        (tmp_path / f"{name}.jsonl.gz").write_bytes(gzip.compress(make_log(name=name)))

    async def main() -> list[str]:
        async with open_services(settings, ModelEvents()) as services:
            for _ in range(2):
                await show_samples(services, tmp_path)
            return [item.name for item in services.localizations.list_all(None)]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("app.demo.SAMPLE_OPTIONS", {"mode": "offline", "regions": 2})
        assert asyncio.run(main()) == ["flat-changed"]


def test_every_sample_that_comes_with_the_product_can_be_read(settings: Settings) -> None:
    folder = PACKAGE_ROOT / "sample_logs"
    files: list[Any] = sorted(folder.glob("*.jsonl.gz"))
    assert len(load(settings, folder)[0]) == len(files)
