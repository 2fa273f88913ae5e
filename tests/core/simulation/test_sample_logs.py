"""The sample logs are what their command makes."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest

from core.log_readers import read_log
from core.simulation.sample_logs import SAMPLES, write_samples

FOLDER = Path(__file__).resolve().parents[3] / "sample_logs"
LARGEST = 120_000


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return write_samples(tmp_path_factory.mktemp("samples"))


def test_the_command_makes_the_same_logs_bit_for_bit(made: list[Path]) -> None:
    assert {path.name for path in made} == {path.name for path in FOLDER.glob("*.jsonl.gz")}
    for path in made:
        # what is packed, not the packing: zlib's versions pack differently
        assert gzip.decompress(path.read_bytes()) == gzip.decompress(
            (FOLDER / path.name).read_bytes()
        ), path.name


def test_each_is_small_and_described(made: list[Path]) -> None:
    readme = (FOLDER / "README.md").read_text(encoding="utf-8")
    for name in SAMPLES:
        assert (FOLDER / f"{name}.jsonl.gz").stat().st_size < LARGEST
        assert f"`{name}.jsonl.gz`" in readme


def test_each_is_read_without_complaint(made: list[Path]) -> None:
    for path in made:
        loaded = read_log(path)
        assert len(loaded.log) > 300
        assert loaded.log.truth is not None
