"""Result folders that are complete or not there at all."""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from core.errors import InputError

MARK = "map.yaml"
"""A folder that holds this file is a result of ours or of map_server and may be replaced."""


@contextlib.contextmanager
def complete_folder(target: Path, mark: str = MARK, what: str = "map or model") -> Iterator[Path]:
    """A fresh folder that takes the place of `target` when the work succeeds.

    Args:
        target: the folder that the user chose.
        mark: name of the file by which an earlier result is known.
        what: kind of folder, for the message.

    Raises:
        InputError: `target` exists and is something else than an earlier result or an empty folder.
    """
    target = target.absolute()
    if target.exists() and not replaceable(target, mark):
        raise InputError(f"{target.name} exists and is no {what} folder: choose another --out")
    target.parent.mkdir(parents=True, exist_ok=True)
    fresh = Path(tempfile.mkdtemp(prefix=f".{target.name}-", dir=target.parent))
    fresh.chmod(0o755)
    try:
        yield fresh
        if target.exists():
            old = Path(tempfile.mkdtemp(prefix=f".{target.name}-old-", dir=target.parent))
            target.replace(old / target.name)
            fresh.replace(target)
            shutil.rmtree(old)
        else:
            fresh.replace(target)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)


def replaceable(folder: Path, mark: str = MARK) -> bool:
    """Whether a folder is an earlier result or empty."""
    return folder.is_dir() and ((folder / mark).is_file() or not any(folder.iterdir()))
