"""Bytes of a log, streamed: plain or gzip, line by line, never more than the limits allow."""

from __future__ import annotations

import gzip
import io
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from core.errors import LogError, TooLargeError
from core.log_readers.limits import DEFAULT_LIMITS, ReadLimits

GZIP_MAGIC = b"\x1f\x8b"
HEAD_BYTES = 4096
"""How much of a file the formats may look at to know their own."""
MEBIBYTE = 2**20
MAX_SHOWN_NAME = 200
MAX_SHOWN_REASON = 80


@dataclass(frozen=True)
class LogSource:
    """A log as it was given.

    Attributes:
        path: a file or a folder.
        name: the file as the user knows it, for messages.
        head: the first bytes of a file, unpacked where it is a gzip; empty for a folder.
        limits: how much it may ask for.
    """

    path: Path
    name: str
    head: bytes
    limits: ReadLimits = DEFAULT_LIMITS

    @classmethod
    def of(cls, path: Path, limits: ReadLimits = DEFAULT_LIMITS) -> LogSource:
        """Looks at what is at `path`.

        Raises:
            LogError: there is nothing, or nothing that can be read.
        """
        name = printable(path.name or str(path))
        with reading(name):
            if path.is_dir():
                return cls(path, name, b"", limits)
            if not path.is_file():
                what = "neither a file nor a folder" if path.exists() else "no such file or folder"
                raise LogError(what, name)
            with path.open("rb") as raw:
                head = _head(raw)
        if not head:
            raise LogError("the file is empty", name)
        return cls(path, name, head, limits)


class ByteBudget:
    """Counts what a log unpacks to, over all of its files.

    Besides the limit on the whole, a log of `packed` bytes may not unpack to more than `max_ratio` times
    that: a drive has noise in it and packs badly, a bomb does not.
    """

    def __init__(self, limits: ReadLimits, packed: int) -> None:
        plausible = max(limits.max_ratio * packed, limits.ratio_counts_from)
        self.limit = min(limits.max_bytes, plausible)
        self.spent = 0

    def spend(self, count: int, source: str) -> None:
        """Adds `count` bytes.

        Raises:
            TooLargeError: the log is larger than the limit.
        """
        self.spent += count
        if self.spent > self.limit:
            raise TooLargeError(
                f"{source}: the log unpacks to more than {self.limit // MEBIBYTE} MB; "
                "split the drive into shorter logs"
            )


def printable(name: str) -> str:
    """A file name as it may stand in a one-line message."""
    return "".join(c if c.isprintable() else "?" for c in name[:MAX_SHOWN_NAME])


def unpacked(raw: IO[bytes]) -> IO[bytes]:
    """The stream itself, or what is inside where it is a gzip (told by its first bytes)."""
    buffered = raw if isinstance(raw, io.BufferedReader) else io.BufferedReader(raw)  # type: ignore[type-var]
    if buffered.peek(2)[:2] == GZIP_MAGIC:
        return gzip.GzipFile(fileobj=buffered, mode="rb")  # type: ignore[return-value]
    return buffered


@contextmanager
def reading(source: str, line: Callable[[], int | None] = lambda: None) -> Iterator[None]:
    """Turns everything that can go wrong with packed bytes into a LogError at the current line."""
    try:
        yield
    except EOFError as error:
        raise LogError(
            "the gzip file ends early: copy it again, or unpack what there is with zcat",
            source,
            line(),
        ) from error
    except (zlib.error, gzip.BadGzipFile, zipfile.BadZipFile) as error:
        reason = printable(str(error))[:MAX_SHOWN_REASON]
        raise LogError(f"the packed file is damaged ({reason})", source, line()) from error
    except OSError as error:
        raise LogError(f"cannot be read ({_reason(error)})", source, line()) from error


def numbered_lines(
    stream: IO[bytes], source: str, budget: ByteBudget, limits: ReadLimits
) -> Iterator[tuple[int, bytes]]:
    """The lines of a stream with their 1-based numbers, line ends included.

    Raises:
        LogError: the packed file is damaged or cut.
        TooLargeError: a line, the number of lines or the whole is beyond the limits.
    """
    number = 0
    with reading(source, lambda: number + 1):
        while line := stream.readline(limits.max_line_bytes + 1):
            number += 1
            if len(line) > limits.max_line_bytes:
                raise TooLargeError(
                    f"{source}, line {number}: longer than {limits.max_line_bytes // MEBIBYTE} MB"
                )
            if number > limits.max_lines:
                raise TooLargeError(f"{source}: more than {limits.max_lines} lines")
            budget.spend(len(line), source)
            yield number, line


def _head(raw: IO[bytes]) -> bytes:
    """The first bytes of a file, unpacked; a gzip that ends early gives what is there."""
    data = raw.read(HEAD_BYTES)
    if data[:2] != GZIP_MAGIC:
        return data
    unpacker = zlib.decompressobj(zlib.MAX_WBITS | 16)  # with a gzip header
    head = unpacker.decompress(data, HEAD_BYTES)
    if not head and not unpacker.eof:
        raise EOFError
    return head


def _reason(error: OSError) -> str:
    return error.strerror or printable(str(error))[:MAX_SHOWN_REASON]
