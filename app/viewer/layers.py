"""The layers of the 3D view, and how a tab switches them without the others noticing.

A layer is a group `/<layer>` of the server's scene. A tab gets a group of the same name in its own
scene: viser lets a client's node stand in for the server's node of that name, so hiding the client's
group hides what the server has drawn below it, in that tab only.
"""

from __future__ import annotations

from collections.abc import Mapping

from app.viewer.canvas import Canvas

GRID, REGIONS, WALLS, CELLS = "grid", "regions", "walls", "cells"
GRAPH, LABELS, PATH, BARS, ROBOT = "graph", "labels", "trajectory", "bars", "robot"
BEAMS = "beams"
DRIFT_MAPS, ODOMETRY_PATH, CORRECTED_PATH, CLOSURES = "maps", "odometry", "corrected", "closures"
"""Of the drift, which is shown instead of the model."""

DEFAULT_LAYERS: Mapping[str, bool] = {
    GRID: True,
    REGIONS: True,
    WALLS: True,
    CELLS: False,
    GRAPH: True,
    LABELS: True,
    PATH: False,
    BARS: True,
    ROBOT: True,
    BEAMS: True,
    DRIFT_MAPS: True,
    ODOMETRY_PATH: True,
    CORRECTED_PATH: True,
    CLOSURES: True,
}
"""Every layer, in the order of the page, and whether it is shown at first."""

THEMES = ("light", "dark")
THEMED = (GRID, REGIONS, GRAPH)
"""Layers that look different in the themes: `/<layer>/<theme>`."""


class LayerSwitch:
    """The groups of one scene: of a server (the defaults) or of a tab (what is shown there)."""

    def __init__(self, canvas: Canvas) -> None:
        self._groups = {
            layer: canvas.group(f"/{layer}", visible) for layer, visible in DEFAULT_LAYERS.items()
        }
        self._themes = {
            (layer, theme): canvas.group(f"/{layer}/{theme}", theme == THEMES[0])
            for layer in THEMED
            for theme in THEMES
        }

    def show(self, layers: Mapping[str, bool]) -> None:
        """Shows and hides layers; unknown names are ignored."""
        for layer, visible in layers.items():
            if layer in self._groups:
                self._groups[layer].visible = visible

    def wear(self, theme: str) -> None:
        """Shows the pictures of a theme."""
        for (_, name), group in self._themes.items():
            group.visible = name == theme
