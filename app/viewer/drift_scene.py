"""What one tab sees of the drift of a drive: two maps faded into each other, paths and closures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from app.viewer.canvas import Canvas
from app.viewer.drawing import Drawing
from app.viewer.drift_drawing import ClosureMark, DriftDrawing, MapPixels
from app.viewer.floor_image import Picture
from app.viewer.graph_shapes import icosphere
from app.viewer.layers import CLOSURES, CORRECTED_PATH, DRIFT_MAPS, ODOMETRY_PATH
from app.viewer.messages import Drift
from app.viewer.palette import Colour
from app.viewer.paths import path_colours, thinned
from core.geometry import FloatArray

PATH = "drive"
"""The group of the drive as it is between odometry and correction; it has no layer: it is always there."""
ODOMETRY: Colour = (222, 96, 84)
CORRECTED: Colour = (24, 92, 255)
ACCEPTED: Colour = (22, 150, 80)
CHOSEN: Colour = (224, 36, 94)
MAP_LEVELS: Mapping[str, float] = {"corrected": 0.012, "odometry": 0.02}
PATH_LEVEL, GHOST_LEVEL, CLOSURE_LEVEL, CHOSEN_LEVEL = 0.06, 0.045, 0.09, 0.13
PATH_WIDTH, GHOST_WIDTH, CLOSURE_WIDTH, CHOSEN_WIDTH = 0.05, 0.025, 0.035, 0.11
MARK_RADIUS = 0.13
"""Metres."""


class DriftScene:
    """The drift in a client's scene; it only draws."""

    def __init__(self, canvas: Canvas) -> None:
        self._canvas = canvas

    def show(
        self,
        drawing: Drawing,
        drift: DriftDrawing,
        wanted: Drift,
        pictures: Mapping[str, tuple[Picture, MapPixels]],
    ) -> None:
        """Draws the drive somewhere between odometry and correction.

        Args:
            drawing: of the model.
            drift: of its drive.
            wanted: how far corrected, and which closure and places are marked.
            pictures: the maps in the colours of the theme, by the name in MAP_LEVELS.
        """
        size = drawing.mark_scale
        for name, level in MAP_LEVELS.items():
            self._map(f"/{DRIFT_MAPS}/{name}", level, pictures.get(name))
        keep = thinned(drift.corrected, 0.05)
        for layer, poses, colour in (
            (ODOMETRY_PATH, drift.odometry, ODOMETRY),
            (CORRECTED_PATH, drift.corrected, CORRECTED),
        ):
            line = _line(poses[keep, :2], GHOST_LEVEL)
            self._lines(f"/{layer}/line", line, colour, GHOST_WIDTH * size)
        between = drift.between(wanted.share)
        line = _line(between[keep], PATH_LEVEL)
        self._canvas.lines(f"/{PATH}/line", line, path_colours(len(line)), PATH_WIDTH * size)
        self._closures(drift, between, wanted.closure, size)
        self._marks(drift, between, wanted.places, size)

    def clear(self) -> None:
        """Takes all of it out; the layers stay."""
        for name in (
            *(f"/{DRIFT_MAPS}/{name}" for name in MAP_LEVELS),
            f"/{ODOMETRY_PATH}/line",
            f"/{CORRECTED_PATH}/line",
            *(f"/{CLOSURES}/{name}" for name in ("accepted", "chosen")),
            f"/{PATH}",
        ):
            self._canvas.remove(name)

    def _map(self, name: str, level: float, shown: tuple[Picture, MapPixels] | None) -> None:
        if shown is None:
            self._canvas.remove(name)
            return
        picture, geometry = shown[0], shown[1].geometry
        rows, cols = geometry.shape
        x, y = geometry.world_of(np.array([rows / 2 - 0.5, cols / 2 - 0.5])).tolist()
        extent = (cols * geometry.resolution, rows * geometry.resolution)
        self._canvas.image(name, picture, extent, (x, y, level), geometry.origin[2])

    def _closures(
        self, drift: DriftDrawing, between: FloatArray, chosen: str | None, size: float
    ) -> None:
        """Those that are used, and the chosen one whether it is or not."""
        marks = [mark for mark in drift.closures if mark.accepted]
        segments = _segments(marks, between, CLOSURE_LEVEL)
        self._lines(f"/{CLOSURES}/accepted", segments, ACCEPTED, CLOSURE_WIDTH * size)
        marks = [mark for mark in drift.closures if mark.id == chosen]
        segments = _segments(marks, between, CHOSEN_LEVEL)
        self._lines(f"/{CLOSURES}/chosen", segments, CHOSEN, CHOSEN_WIDTH * size)

    def _marks(
        self, drift: DriftDrawing, between: FloatArray, places: Sequence[float], size: float
    ) -> None:
        """Balls where somebody pointed at the drive."""
        rows = [drift.row_at(t) for t in places]
        centres = np.column_stack((between[rows], np.full(len(rows), CHOSEN_LEVEL)))
        radii = np.full(len(rows), MARK_RADIUS * size)
        name = f"/{PATH}/places"
        if self._canvas.instances(name, icosphere(2), centres, radii, [CHOSEN] * len(rows)) is None:
            self._canvas.remove(name)

    def _lines(self, name: str, segments: FloatArray, colour: Colour, width: float) -> None:
        if self._canvas.lines(name, segments, colour, width) is None:
            self._canvas.remove(name)


def _line(points: FloatArray, level: float) -> FloatArray:
    """(N - 1, 2, 3) the segments through points (N, 2)."""
    line = np.column_stack((points, np.full(len(points), level)))
    return np.stack((line[:-1], line[1:]), axis=1)


def _segments(marks: Sequence[ClosureMark], between: FloatArray, level: float) -> FloatArray:
    """(M, 2, 3) a segment from end to end of each closure."""
    ends = np.array([(mark.source, mark.target) for mark in marks], np.int64).reshape(-1, 2)
    return np.concatenate((between[ends], np.full((*ends.shape, 1), level)), axis=2)
