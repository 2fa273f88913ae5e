"""Colours that mean the same in all figures."""

from __future__ import annotations

UNKNOWN, FREE, OCCUPIED = "#e6e6ea", "#ffffff", "#22252b"
MAP_SCALE = [[0.0, UNKNOWN], [0.5, FREE], [1.0, OCCUPIED]]
"""Of a trinary grid, 0..2."""
HUE_STEP, SATURATIONS, LIGHTNESSES = 137.508, (62, 45), (62, 50, 72)
"""Of the colours of regions: hues a golden angle apart are far from those just before."""
PATH, TEMPLATE, TRUTH = "#1f6feb", "#d1242f", "#1a7f37"
UPDATED, REJECTED = "#1f6feb", "#e8710a"
"""Steps that changed the belief, and steps that were rejected."""
UNKNOWN_PLACE = "#888888"
"""The bar of "nowhere in the map"."""
GONE, ADDED = "#e45756", "#1f6feb"
METHODS = {"default": "#1f6feb", "paper": "#8250df", "mcl": "#1a7f37"}


def region_colour(value: int) -> str:
    """The colour of a region by its value in the label image."""
    hue = round(value * HUE_STEP % 360)
    saturation = SATURATIONS[value % len(SATURATIONS)]
    return f"hsl({hue},{saturation}%,{LIGHTNESSES[value % len(LIGHTNESSES)]}%)"
