"""The user's page on log files says what the program does."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from core.log_readers import read_log
from core.log_readers.limits import DEFAULT_LIMITS
from core.log_readers.ring_file import ring_from_bytes
from core.log_readers.text_description import TextFile, parse_description
from core.sensing import RING_PRESETS

PAGE = (Path(__file__).resolve().parents[3] / "static" / "docs" / "logs.md").read_text("utf-8")


def example(kind: str, number: int = 0) -> str:
    return re.findall(rf"```{kind}\n(.*?)```", PAGE, re.DOTALL)[number]


def test_the_native_example_is_a_log(tmp_path: Path) -> None:
    (tmp_path / "log.jsonl").write_text(example("json"), encoding="utf-8")
    log = read_log(tmp_path / "log.jsonl").log
    assert (log.name, len(log), len(log.ring)) == ("ground floor", 2, 2)


def test_the_description_example_is_one() -> None:
    description = parse_description(example("yaml").encode(), "page", DEFAULT_LIMITS)
    assert description.ring in RING_PRESETS
    assert len(description.files) == 2


def test_the_ring_example_is_a_ring() -> None:
    ring = ring_from_bytes(example("yaml", 1).encode(), "page")
    assert len(ring) == 3
    assert ring.max_range == 5.0


@pytest.mark.parametrize("field", TextFile.model_fields)
def test_every_field_of_a_file_is_described(field: str) -> None:
    assert f"`{field}`" in PAGE


@pytest.mark.parametrize("preset", RING_PRESETS)
def test_every_preset_is_named(preset: str) -> None:
    assert f"`{preset}`" in PAGE
