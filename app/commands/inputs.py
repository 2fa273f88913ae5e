"""What a path on the command line is: a log or a map."""

from __future__ import annotations

from pathlib import Path

from core.errors import InputError
from core.log_readers import read_log
from core.log_readers.ring_file import load_ring
from core.progress import Progress, no_progress
from core.sensing import RobotLog

MAP_KEYS = (b"image:", b"resolution:")


def map_yaml_of(path: Path) -> Path | None:
    """The map.yaml that a path means, or None when it is a log.

    Raises:
        InputError: there is nothing at the path.
    """
    if not path.exists():
        raise InputError(f"{path}: no such file or folder")
    if path.is_dir():
        return path / "map.yaml" if (path / "map.yaml").is_file() else None
    if path.suffix.lower() not in (".yaml", ".yml"):
        return None
    with path.open("rb") as file:
        head = file.read(65536)
    return path if all(key in head for key in MAP_KEYS) else None


def load_log(path: Path, ring: str | None, progress: Progress = no_progress) -> RobotLog:
    """The drive in a log of any supported format, without its truth.

    Raises:
        LogError: it cannot be read.
    """
    if not path.exists():
        raise InputError(f"{path}: no such file or folder")
    known = load_ring(ring) if ring else None
    return read_log(path, known, progress).log.without_truth()
