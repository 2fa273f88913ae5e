"""How long work tells how far it is."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float, str], None]
"""Called with the finished share (0..1) and what is being done; may raise CancelledError."""


def no_progress(share: float, what: str) -> None:
    """Progress that nobody watches."""


def part_of(progress: Progress, start: float, stop: float) -> Progress:
    """A progress for one stage whose 0..1 is `start`..`stop` of the whole."""

    def report(share: float, what: str) -> None:
        progress(start + (stop - start) * min(max(share, 0.0), 1.0), what)

    return report
