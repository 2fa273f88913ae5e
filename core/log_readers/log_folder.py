"""The files of a log that has several: in a folder, or in a zip that is never unpacked to disk."""

from __future__ import annotations

import posixpath
import stat
import struct
import zipfile
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import IO, Protocol

from core.errors import LogError, TooLargeError
from core.log_readers.byte_source import ByteBudget, printable, reading, unpacked
from core.log_readers.limits import ReadLimits

DESCRIPTION_NAMES = ("log.yaml", "log.yml")
ZIP_MAGIC = (b"PK\x03\x04", b"PK\x05\x06")
_END_OF_DIRECTORY = b"PK\x05\x06"
_ZIP64_LOCATOR = b"PK\x06\x07"
_END_BYTES = 22 + 2**16 + 20
"""The end record of a zip, its longest comment, and a zip64 locator before it."""


class LogFolder(Protocol):
    """Files by their relative names; `packed_bytes` is what they take on disk altogether."""

    description: str
    packed_bytes: int

    def open(self, name: str) -> AbstractContextManager[IO[bytes]]:
        """The bytes of a file, unpacked where it is a gzip.

        Raises:
            LogError: no such file in the folder, or a name that leads out of it.
        """

    def shown(self, name: str) -> str:
        """The file as the user knows it."""

    def size(self, name: str) -> int:
        """Bytes of the file, before unpacking a gzip."""


class DiskFolder:
    """A folder on disk; `description` is its `log.yaml`."""

    def __init__(self, path: Path, description: str) -> None:
        self.path = path
        self.description = description
        self.packed_bytes = sum(entry.stat().st_size for entry in path.iterdir() if entry.is_file())

    @contextmanager
    def open(self, name: str) -> Iterator[IO[bytes]]:
        """See `LogFolder`. Only ordinary files are opened."""
        path = self.path / _inside(name, self.shown(self.description))
        if not path.is_file():
            raise LogError(f"there is no file {name!r} beside it", self.shown(self.description))
        with reading(self.shown(name)), path.open("rb") as raw:
            yield unpacked(raw)

    def shown(self, name: str) -> str:
        """See `LogFolder`."""
        return printable(posixpath.join(self.path.name, name))

    def size(self, name: str) -> int:
        """See `LogFolder`."""
        return (self.path / _inside(name, self.description)).stat().st_size


class ZipFolder:
    """A zip, or the one folder in it that holds the `log.yaml`."""

    def __init__(self, archive: zipfile.ZipFile, shown: str, packed_bytes: int) -> None:
        self._archive = archive
        self._shown = shown
        self.packed_bytes = packed_bytes
        candidates = [
            name
            for name in archive.namelist()
            if posixpath.basename(name) in DESCRIPTION_NAMES and name.count("/") <= 1
        ]
        if not candidates:
            raise LogError("the zip has no log.yaml that says what its files mean", shown)
        first = min(candidates, key=lambda name: (name.count("/"), name))
        self._prefix, self.description = posixpath.split(first)

    @contextmanager
    def open(self, name: str) -> Iterator[IO[bytes]]:
        """See `LogFolder`. Links, encrypted files and rare packings are refused."""
        info = self._info(name)
        shown = self.shown(name)
        if stat.S_ISLNK(info.external_attr >> 16):
            raise LogError("is a link; put the file itself into the zip", shown)
        if info.flag_bits & 1:
            raise LogError("is encrypted; make the zip without a password", shown)
        if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise LogError("is packed in a rare way; make the zip with plain deflate", shown)
        with reading(shown):
            with damaged_zip(shown):
                raw = self._archive.open(info)
            with raw:
                yield unpacked(raw)

    def shown(self, name: str) -> str:
        """See `LogFolder`."""
        return printable(f"{self._shown}/{name}")

    def size(self, name: str) -> int:
        """See `LogFolder`."""
        return self._info(name).file_size

    def _info(self, name: str) -> zipfile.ZipInfo:
        inside = _inside(name, self.shown(self.description))
        try:
            return self._archive.getinfo(posixpath.join(self._prefix, inside))
        except KeyError as error:
            raise LogError(f"there is no file {name!r} in the zip", self._shown) from error


@contextmanager
def zip_folder(path: Path, shown: str, limits: ReadLimits) -> Iterator[ZipFolder]:
    """Opens a zip whose table of contents is of a sane size.

    Raises:
        LogError: damaged, or without a `log.yaml`.
        TooLargeError: too many files.
    """
    _check_directory(path, shown, limits)
    with reading(shown), damaged_zip(shown):
        archive = zipfile.ZipFile(path)
    with archive:
        if len(archive.infolist()) > limits.max_archive_entries:
            raise TooLargeError(f"{shown}: more than {limits.max_archive_entries} files in the zip")
        yield ZipFolder(archive, shown, path.stat().st_size)


@contextmanager
def damaged_zip(shown: str) -> Iterator[None]:
    """Turns what `zipfile` raises on nonsense in a zip's own tables into a LogError."""
    try:
        yield
    except (struct.error, ValueError, RuntimeError, NotImplementedError, IndexError) as error:
        raise LogError(f"the zip is damaged ({type(error).__name__})", shown) from error


def read_small(folder: LogFolder, name: str, limits: ReadLimits, budget: ByteBudget) -> bytes:
    """A file that must be small (one byte more than the limit is read, never all of a large one)."""
    with folder.open(name) as stream:
        data = stream.read(limits.max_yaml_bytes + 1)
    budget.spend(len(data), folder.shown(name))
    return data


def _inside(name: str, description: str) -> str:
    """The name, if it stays inside the folder."""
    plain = posixpath.normpath(name)
    outside = plain.startswith(("/", "..")) or "\\" in name or ":" in name or "\0" in name
    if outside or plain == ".":
        raise LogError(f"file {name!r} is not inside the log's folder", description)
    return plain


def _check_directory(path: Path, shown: str, limits: ReadLimits) -> None:
    """Refuses a zip with a huge table of contents before `zipfile` reads it into memory."""
    size = path.stat().st_size
    with path.open("rb") as file:
        file.seek(max(size - _END_BYTES, 0))
        tail = file.read()
    end = tail.rfind(_END_OF_DIRECTORY)
    if end < 0:
        raise LogError("the zip is cut or damaged; copy it again", shown)
    length = int.from_bytes(tail[end + 12 : end + 16], "little")
    if (
        length > limits.max_archive_directory_bytes
        or _ZIP64_LOCATOR in tail[max(end - 20, 0) : end]
    ):
        raise TooLargeError(f"{shown}: too many files in the zip, or one beyond 4 GB")
