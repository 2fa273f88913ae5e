"""`timeline.zip` of a model folder: what every step along the drive looked like.

One `NNNN.png` (`segmentation/step_picture.py`) for each step of `history.jsonl`, from 0000 on, which
tells where the picture lies in the world. One file, so that revisions of a model can share it.
"""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from pathlib import Path

from core.errors import ModelError

TIMELINE_FILE = "timeline.zip"
START_OF_TIME = (1980, 1, 1, 0, 0, 0)
"""Of the members, so that the same model is the same file."""


def write_timeline(pictures: Sequence[bytes], path: Path) -> None:
    """Writes the pictures of all steps."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        for step, picture in enumerate(pictures):
            archive.writestr(zipfile.ZipInfo(_member(step), START_OF_TIME), picture)


def read_timeline(path: Path) -> tuple[bytes, ...]:
    """The pictures of all steps; none when there is no such file, as in models of older versions.

    Raises:
        ModelError: the file is not what `write_timeline` makes.
    """
    if not path.is_file():
        return ()
    try:
        with zipfile.ZipFile(path) as archive:
            count = len(archive.infolist())
            return tuple(_read(archive, step) for step in range(count))
    except (zipfile.BadZipFile, OSError) as error:
        raise ModelError(f"{path.name} cannot be read: {error}") from error


def read_step(path: Path, step: int) -> bytes:
    """The picture of one step.

    Raises:
        ModelError: there is none.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            return _read(archive, step)
    except FileNotFoundError as error:
        raise ModelError("this model has no timeline: it was not made along a drive") from error
    except (zipfile.BadZipFile, OSError) as error:
        raise ModelError(f"{path.name} cannot be read: {error}") from error


def _read(archive: zipfile.ZipFile, step: int) -> bytes:
    """A member; they are stored as they are, so that none is larger than the archive itself."""
    try:
        member = archive.getinfo(_member(step))
    except KeyError as error:
        raise ModelError(f"the timeline has no step {step}") from error
    if member.compress_type != zipfile.ZIP_STORED:
        raise ModelError(f"{TIMELINE_FILE}: {member.filename} is compressed")
    return archive.read(member)


def _member(step: int) -> str:
    return f"{step:04d}.png"
