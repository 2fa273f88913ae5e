"""What one format's reader hands over: a log as it stands in the file, before it is checked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from core.geometry import BoolArray, FloatArray, IntArray
from core.sensing.ring import SonarRing

MAX_PLACES = 10
"""How many lines are named for one finding; the count tells how many there were."""


@dataclass(frozen=True)
class Finding:
    """Something in a log that a person should know.

    Attributes:
        what: in words, without the count.
        count: how often.
        source: the file, where the log has several.
        lines: 1-based lines of the first few.
    """

    what: str
    count: int
    lines: tuple[int, ...] = ()
    source: str | None = None

    @classmethod
    def at(cls, what: str, lines: npt.ArrayLike, source: str | None = None) -> Finding:
        """A finding at all of `lines`, of which the first few are named."""
        places = np.asarray(lines, np.int64)
        return cls(what, len(places), tuple(places[:MAX_PLACES].tolist()), source)


@dataclass(frozen=True)
class DraftLog:
    """A log as read, in SI units, in the order of the file.

    Attributes:
        format: name of the format.
        name: what the user calls the log.
        ring: the sonars.
        t: (N,) seconds, in any order.
        odometry: (N, 3) poses in the odometry frame.
        ranges: (N, S) metres; NaN or infinite = no echo.
        lines: (N,) 1-based line of each scan in `source`.
        source: the file that `lines` counts in.
        fresh: (N, S) where the log itself says which values were measured anew, else None.
        truth: (N, 3) true poses or None.
        skipped: what was left out while reading.
        notes: what was accepted though it is odd.
        clock: what was wrong with time stamps that the reader already put in order.
        too_close: (N, S) where a sonar said that something is nearer than it can measure; its range is
            NaN, but that is not "no echo".
    """

    format: str
    name: str
    ring: SonarRing
    t: FloatArray
    odometry: FloatArray
    ranges: FloatArray
    lines: IntArray
    source: str
    fresh: BoolArray | None = None
    truth: FloatArray | None = None
    skipped: tuple[Finding, ...] = ()
    notes: tuple[Finding, ...] = ()
    clock: tuple[Finding, ...] = ()
    too_close: BoolArray | None = None
