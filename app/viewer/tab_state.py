"""What a tab shows, apart from what is played in it."""

from __future__ import annotations

from dataclasses import dataclass, field

from app.viewer.layers import DEFAULT_LAYERS
from app.viewer.measured_line import MeasuredLine

_DEFAULT_HEIGHT = 800.0


@dataclass
class TabState:
    """What a tab shows; it outlives a lost connection."""

    selected: str | None = None
    others: tuple[str, ...] = ()
    layers: dict[str, bool] = field(default_factory=lambda: dict(DEFAULT_LAYERS))
    theme: str = "light"
    measuring: bool = False
    measured: MeasuredLine = field(default_factory=MeasuredLine)
    picking: bool = False
    picture_height: float = _DEFAULT_HEIGHT
    aspect: float | None = None
    """Width over height of the picture as the page sees it; None before it has said so."""
