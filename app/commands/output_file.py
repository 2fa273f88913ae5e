"""Result files that are complete or not there at all."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

from core.errors import InputError


@contextlib.contextmanager
def complete_file(target: Path) -> Iterator[TextIO]:
    """A text file that takes the place of `target` when the work succeeds.

    Raises:
        InputError: `target` is a folder.
    """
    target = target.absolute()
    if target.is_dir():
        raise InputError(f"{target.name} is a folder: give a file to write")
    target.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{target.name}-", dir=target.parent)
    fresh = Path(name)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            yield file
        fresh.chmod(0o644)
        fresh.replace(target)
    finally:
        fresh.unlink(missing_ok=True)
