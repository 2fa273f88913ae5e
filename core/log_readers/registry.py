"""Which formats there are, and how a log is told to be of one: by its content, never by its name."""

from __future__ import annotations

from pathlib import Path

from core.errors import LogError
from core.log_readers import delimited_text, native
from core.log_readers.acceptance import accept
from core.log_readers.byte_source import LogSource
from core.log_readers.foreign import unknown
from core.log_readers.limits import DEFAULT_LIMITS, ReadLimits
from core.log_readers.loaded_log import LoadedLog
from core.log_readers.log_format import LogFormat
from core.progress import Progress, no_progress
from core.sensing.ring import SonarRing

FORMATS: tuple[LogFormat, ...] = (native.FORMAT, delimited_text.FORMAT)
"""Asked in this order. A new format is one file and one entry here."""


def read_log(
    path: Path,
    ring: SonarRing | None = None,
    progress: Progress = no_progress,
    limits: ReadLimits = DEFAULT_LIMITS,
) -> LoadedLog:
    """Reads a log of any known format.

    Args:
        path: a file, a folder or a zip.
        ring: the sonars, for formats that do not tell where they sit.
        progress: told how far the reading is.
        limits: how much the log may ask for.

    Raises:
        LogError: what is wrong, with file and line.
        TooLargeError: the log is beyond the limits.
    """
    source = LogSource.of(Path(path), limits)
    for log_format in FORMATS:
        if log_format.matches(source):
            return accept(log_format.read(source, ring, progress))
    raise LogError(unknown(source), source.name)
