"""The data folder: where the files of logs and models lie, and how they get there whole or not at all."""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from core.errors import InputError

ID_BYTES = 8


def new_id() -> str:
    """A fresh opaque id: 16 hexadecimal digits, never used before."""
    return secrets.token_hex(ID_BYTES)


class DataFolder:
    """Folders of logs, models (by revision), localizations, `temp/`, an SQLite index and a lock.

    Everything new is written into a folder under `temp/` and renamed to its place when it is whole.
    What a crash leaves in `temp/` is removed at the next start.
    """

    def __init__(self, root: Path) -> None:
        self.root = root
        self.logs = root / "logs"
        self.models = root / "models"
        self.localizations = root / "localizations"
        self.temp = root / "temp"
        self.database = root / "echorooms.sqlite"
        self._lock: IO[bytes] | None = None

    def open(self) -> None:
        """Creates the folder where it is missing, takes the lock and clears what a crash left.

        Raises:
            InputError: it cannot be written, or another server uses it.
        """
        try:
            self.root.mkdir(parents=True, exist_ok=True)
            self._lock = _locked(self.root / "lock")
            shutil.rmtree(self.temp, ignore_errors=True)
            for folder in (self.logs, self.models, self.localizations, self.temp):
                folder.mkdir(exist_ok=True)
        except OSError as error:
            raise InputError(
                f"the data folder {self.root} cannot be used ({error.strerror}); "
                "give another one with --data"
            ) from error

    def close(self) -> None:
        """Lets another server use the folder."""
        if self._lock is not None:
            self._lock.close()
            self._lock = None

    @contextlib.contextmanager
    def temporary(self) -> Iterator[Path]:
        """A new folder under `temp/`; what has not been published from it is removed at the end."""
        folder = self.temp / new_id()
        folder.mkdir()
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def publish(self, folder: Path, place: Path) -> None:
        """Makes a finished folder appear at `place`, which must not exist, in one step."""
        for path in (*folder.rglob("*"), folder):
            _sync(path)
        place.parent.mkdir(exist_ok=True)
        folder.rename(place)
        _sync(place.parent)

    def replace_file(self, place: Path, content: bytes) -> None:
        """Makes a file hold something else in one step."""
        fresh = self.temp / new_id()
        fresh.write_bytes(content)
        _sync(fresh)
        fresh.replace(place)
        _sync(place.parent)

    def discard(self, place: Path) -> None:
        """Makes a folder disappear in one step, then frees its space."""
        if place.exists():
            grave = self.temp / new_id()
            place.rename(grave)
            shutil.rmtree(grave, ignore_errors=True)


def size_on_disk(folder: Path) -> int:
    """Bytes of all files in a folder; what several of its folders share counts once."""
    found = (path.stat() for path in folder.rglob("*") if path.is_file())
    return sum({(stat.st_dev, stat.st_ino): stat.st_size for stat in found}.values())


def _sync(path: Path) -> None:
    """Asks the system to bring a file or folder to the disk now."""
    if sys.platform == "win32" and path.is_dir():
        return
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _locked(path: Path) -> IO[bytes]:
    """The lock file, held until it is closed or the process ends."""
    file = path.open("ab")
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        file.close()
        raise InputError(
            f"the data folder {path.parent} is in use by another EchoRooms server; "
            "stop that one or give another folder with --data"
        ) from error
    return file
