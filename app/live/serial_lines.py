"""The lines that a microcontroller with a ring of sonars prints, as scans.

    millis;x_mm;y_mm;heading_mrad;r1;r2;...;rN*HH

`r1` .. `rN` are distances in millimetres in the order of the ring, 0 or less = no echo; `*HH` is the
exclusive or of all characters before the star, as two hexadecimal digits (NMEA 0183 does the same),
and may be left out. `millis` counts from the board's start; after a reset it begins again, and so
does odometry: time and pose go on from the last line's.
"""

from __future__ import annotations

import functools
import operator
from typing import Any

import numpy as np

from core.errors import LogError
from core.geometry import FloatArray, compose, inverse
from core.wording import counted

LONGEST_LINE = 2048
ROLL_OVER_S = 2**32 / 1000
"""`millis` of 32 bits begins again after 49 days; a step back by nearly so much is no reset."""
RESTART_S = 0.05
"""Between the last line before a reset and the first one after it: unknown, but not nothing."""


class SerialLines:
    """Makes scan records of lines, in order."""

    def __init__(self, sonars: int, after: float | None = None) -> None:
        """`after`: the time of the last scan that is known already; new ones come later."""
        self._sonars = sonars
        self._after = after
        self._clock: float | None = None
        self._offset = 0.0
        self._frame: FloatArray = np.zeros(3)
        self._pose: FloatArray = np.zeros(3)

    def record(self, line: bytes) -> dict[str, Any]:
        """The scan of a line.

        Raises:
            LogError: it is no whole line of this form.
        """
        millis, x, y, heading, *ranges = self._numbers(line)
        if len(ranges) != self._sonars:
            raise LogError(
                f"{counted(len(ranges), 'distance')} for a ring of {counted(self._sonars, 'sonar')}"
            )
        told = np.array([x / 1000, y / 1000, heading / 1000])
        t = self._time(millis / 1000, told)
        self._pose = compose(self._frame, told)
        return {
            "t": round(t, 4),
            "odom": [round(float(v), 5) for v in self._pose],
            "ranges": [round(r / 1000, 3) if r > 0 else None for r in ranges],
        }

    def _numbers(self, line: bytes) -> list[float]:
        text = line.decode("ascii", "replace").strip()
        body, star, sum_ = text.partition("*")
        if star and sum_.upper() != f"{functools.reduce(operator.xor, body.encode(), 0):02X}":
            raise LogError(f"the check sum of {text[:60]!r} is wrong")
        try:
            numbers = [float(part) for part in body.split(";")]
        except ValueError as error:
            raise LogError(f"{text[:60]!r} is no line of numbers with semicolons") from error
        if len(numbers) < 5 or not np.isfinite(numbers).all():
            raise LogError(f"{text[:60]!r} is no whole line")
        return numbers

    def _time(self, clock: float, told: FloatArray) -> float:
        """Seconds that never go back; after a reset the odometry's frame is moved along."""
        before = self._clock
        if before is None:
            self._offset = 0.0 if self._after is None else max(0.0, self._after + RESTART_S - clock)
        elif clock < before - ROLL_OVER_S / 2:
            self._offset += ROLL_OVER_S
        elif clock < before:
            self._offset += before + RESTART_S - clock
            self._frame = compose(self._pose, inverse(told))
        self._clock = clock
        return clock + self._offset
