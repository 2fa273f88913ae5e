"""Options and data shared by all tests."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--data",
        default=str(ROOT.parent / "shared"),
        help="folder with real logs, homes and rooms (tests that need it are skipped without)",
    )


def skip_or_fail(reason: str) -> None:
    """Skips on a developer's machine; fails where everything must be there."""
    if os.environ.get("CI"):
        pytest.fail(reason)
    pytest.skip(reason)


@pytest.fixture(scope="session")
def need() -> Callable[[str], None]:
    """`skip_or_fail`, for test folders, which cannot import this file."""
    return skip_or_fail


@pytest.fixture(scope="session")
def data_dir(request: pytest.FixtureRequest) -> Path:
    """The folder with real data."""
    folder = Path(request.config.getoption("--data")).resolve()
    if not (folder / "logs").is_dir():
        skip_or_fail(f"no real data in {folder}; give --data DIR")
    return folder
