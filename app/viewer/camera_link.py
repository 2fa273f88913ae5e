"""Two views of one page whose cameras go together."""

from __future__ import annotations

import time
from collections.abc import Callable

from app.viewer.camera import View, near

ECHO_S = 0.6
"""For so long after it was sent somewhere, what a browser tells of its camera is not a person's move."""


class CameraLink:
    """One end of a link. Event loop's thread only."""

    def __init__(
        self, stand_as: Callable[[View], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._stand_as = stand_as
        self._clock = clock
        self._other: CameraLink | None = None
        self._at: View | None = None
        self._sent_at = -ECHO_S

    def join(self, other: CameraLink | None) -> None:
        """Goes together with another camera from now on, or with none."""
        if self._other is not None:
            self._other._other = None
        self._other = other
        if other is not None:
            other._other = self

    def moved(self, view: View) -> None:
        """This camera has moved: the other one follows, unless it was the other that moved it."""
        if self._clock() - self._sent_at < ECHO_S:
            return
        if self._other is None or (self._at is not None and near(view, self._at)):
            return
        self._at = view
        self._other._follow(view)

    def _follow(self, view: View) -> None:
        self._at, self._sent_at = view, self._clock()
        self._stand_as(view)
