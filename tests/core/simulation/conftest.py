"""Drives that several tests look at."""

from __future__ import annotations

import pytest

from core.sensing import RobotLog
from core.simulation import Home, build_home, simulate


@pytest.fixture(scope="session")
def paper() -> Home:
    return build_home("paper")


@pytest.fixture(scope="session")
def paper_tour(paper: Home) -> RobotLog:
    return simulate(paper, seed=1)
