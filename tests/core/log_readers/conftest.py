"""Logs to read, as text that a test can spoil."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

SONAR = {"x": 0.1, "y": 0.0, "beam_width": 0.8, "min_range": 0.1, "max_range": 4.0}


@pytest.fixture
def header() -> dict[str, Any]:
    """A native header with three sonars."""
    return {
        "format": "echorooms-log",
        "version": 1,
        "name": "drive",
        "robot": {"radius": 0.2},
        "sonars": [SONAR | {"heading": heading} for heading in (0.0, 1.57, -1.57)],
    }


@pytest.fixture
def scans() -> list[dict[str, Any]]:
    """Sixty scans of a robot that drives 5.9 m straight on past a wall."""
    return [
        {
            "t": i * 0.25,
            "odom": [i * 0.1, 0.0, 0.0],
            "ranges": [3.9 - i * 0.05, 1.0 + i % 7 / 50, None],
        }
        for i in range(60)
    ]


@pytest.fixture
def write_lines(tmp_path: Path) -> Callable[..., Path]:
    """Writes lines, dicts as JSON, into a file."""

    def write(*lines: Any, name: str = "log.jsonl") -> Path:
        path = tmp_path / name
        texts = (line if isinstance(line, str) else json.dumps(line) for line in lines)
        path.write_text("".join(text + "\n" for text in texts), encoding="utf-8")
        return path

    return write
