"""Colours that mean the same in all figures."""

from __future__ import annotations

UNKNOWN, FREE, OCCUPIED = "#e6e6ea", "#ffffff", "#22252b"
MAP_SCALE = [[0.0, UNKNOWN], [0.5, FREE], [1.0, OCCUPIED]]
"""Of a trinary grid, 0..2."""
REGIONS = (
    "#4c78a8", "#f58518", "#54a24b", "#e45756", "#72b7b2", "#eeca3b", "#b279a2", "#ff9da6",
    "#9d755d", "#bab0ac", "#1f9e89", "#d67195", "#8a9a5b", "#6a51a3", "#c7a252", "#3b8ea5",
)  # fmt: skip
PATH, TEMPLATE, TRUTH = "#1f6feb", "#d1242f", "#1a7f37"
UPDATED, REJECTED = "#1f6feb", "#e8710a"
"""Steps that changed the belief, and steps that were rejected."""
GONE, ADDED = "#e45756", "#1f6feb"
METHODS = {"default": "#1f6feb", "paper": "#8250df", "mcl": "#1a7f37"}


def region_colour(value: int) -> str:
    """The colour of a region by its value in the label image."""
    return REGIONS[(value - 1) % len(REGIONS)]
