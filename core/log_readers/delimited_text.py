"""Plain text files described by a `log.yaml`: a folder, a zip, or the `log.yaml` itself."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from core.errors import LogError, TooLargeError
from core.log_readers.byte_source import ByteBudget, LogSource, numbered_lines
from core.log_readers.draft_log import DraftLog
from core.log_readers.limits import ReadLimits
from core.log_readers.log_folder import (
    DESCRIPTION_NAMES,
    ZIP_MAGIC,
    DiskFolder,
    LogFolder,
    read_small,
    zip_folder,
)
from core.log_readers.log_format import LogFormat
from core.log_readers.ring_file import parse_ring, ring_from_bytes
from core.log_readers.text_description import TextDescription, TextFile, parse_description
from core.log_readers.text_join import joined
from core.log_readers.text_streams import FileStreams, streams_of
from core.log_readers.text_table import read_table
from core.progress import Progress, part_of
from core.sensing.ring import RING_PRESETS, SonarRing

FORMAT_NAME = "delimited text"
_DESCRIPTION = re.compile(rb"^(files *:|format *: *.?echorooms-text)", re.MULTILINE)


def read_delimited_text(source: LogSource, ring: SonarRing | None, progress: Progress) -> DraftLog:
    """Reads what a `log.yaml` describes.

    Raises:
        LogError: file and line, and what is wrong there.
        TooLargeError: beyond the limits.
    """
    limits = source.limits
    with _folder(source) as folder:
        budget = ByteBudget(limits, folder.packed_bytes)
        data = read_small(folder, folder.description, limits, budget)
        shown = folder.shown(folder.description)
        description = parse_description(data, shown, limits)
        ring = _ring(description, ring, folder, limits, budget)
        parts: list[FileStreams] = []
        for i, file in enumerate(description.files):
            share = part_of(progress, i / len(description.files), (i + 1) / len(description.files))
            parts.append(_read_file(folder, file, len(ring), limits, budget, share))
            scans = sum(len(part.t) for part in parts if len(part.sonars))
            if scans * len(ring) > limits.max_readings:
                raise TooLargeError(f"{shown}: more than {limits.max_readings} readings")
    name = description.name or re.sub(r"\.(zip|ya?ml)$", "", source.name)
    return joined(FORMAT_NAME, name, ring, parts)


def _matches(source: LogSource) -> bool:
    """A folder, a zip, or a text that looks like a `log.yaml`."""
    if source.path.is_dir():
        return any((source.path / name).is_file() for name in DESCRIPTION_NAMES)
    return source.head.startswith(ZIP_MAGIC) or bool(_DESCRIPTION.search(source.head))


FORMAT = LogFormat(FORMAT_NAME, _matches, read_delimited_text)


@contextmanager
def _folder(source: LogSource) -> Iterator[LogFolder]:
    """Where the files are."""
    if source.path.is_dir():
        names = [name for name in DESCRIPTION_NAMES if (source.path / name).is_file()]
        yield DiskFolder(source.path, names[0])
    elif source.head.startswith(ZIP_MAGIC):
        with zip_folder(source.path, source.name, source.limits) as folder:
            yield folder
    else:
        yield DiskFolder(source.path.parent, source.path.name)


def _ring(
    description: TextDescription,
    given: SonarRing | None,
    folder: LogFolder,
    limits: ReadLimits,
    budget: ByteBudget,
) -> SonarRing:
    """The log's own ring, or the one that was given where it has none."""
    shown = folder.shown(folder.description)
    own = description.ring
    if own is None:
        if given is None:
            raise LogError(
                f"no `ring`; name one ({', '.join(RING_PRESETS)}), write its table, or give --ring",
                shown,
            )
        return given
    if isinstance(own, str):
        if own in RING_PRESETS:
            return RING_PRESETS[own]
        return ring_from_bytes(read_small(folder, own, limits, budget), folder.shown(own), limits)
    try:
        return parse_ring(own, limits)
    except LogError as error:
        raise LogError(f"ring: {error}", shown) from error
    except TooLargeError as error:
        raise TooLargeError(f"{shown}: {error}") from error


def _read_file(
    folder: LogFolder,
    file: TextFile,
    sonars: int,
    limits: ReadLimits,
    budget: ByteBudget,
    progress: Progress,
) -> FileStreams:
    """One of the files, in SI units and in order of time."""
    shown = folder.shown(file.path)
    before = budget.spent
    with folder.open(file.path) as stream:
        size = max(folder.size(file.path), 1)
        table = read_table(
            numbered_lines(stream, shown, budget, limits),
            file,
            shown,
            limits,
            lambda: progress((budget.spent - before) / size, f"reading {file.path}"),
        )
    return streams_of(table, file, shown, sonars, limits)
