"""What a format must offer to be read; each lives in one file that ends in its `FORMAT`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from core.log_readers.byte_source import LogSource
from core.log_readers.draft_log import DraftLog
from core.progress import Progress
from core.sensing.ring import SonarRing


@dataclass(frozen=True)
class LogFormat:
    """A format of robot logs.

    Attributes:
        name: as reports call it.
        matches: whether a source is of this format, told by its content.
        read: reads it; the ring serves formats without geometry.
    """

    name: str
    matches: Callable[[LogSource], bool]
    read: Callable[[LogSource, SonarRing | None, Progress], DraftLog]
