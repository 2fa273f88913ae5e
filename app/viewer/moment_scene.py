"""What one tab sees of a moment of the drive: the map as it was, hulls, cuts and the robot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.viewer.canvas import Canvas
from app.viewer.drawing import Drawing
from app.viewer.floor_image import DARK, LIGHT, Picture
from app.viewer.moment_picture import moment_picture
from app.viewer.palette import Colour
from core.geometry import FloatArray
from core.topology.timeline import picture_on_map

GROUP = "/moment"
ACCEPTED: Colour = (22, 150, 80)
REJECTED: Colour = (150, 120, 60)
CUT: Colour = (224, 36, 94)
FLOOR_LEVEL, HULL_LEVEL, CUT_LEVEL = 0.012, 0.05, 0.07
HULL_WIDTH, CHOSEN_WIDTH, CUT_WIDTH = 0.035, 0.09, 0.07
"""Metres."""
THEMES = {"light": LIGHT, "dark": DARK}


@dataclass(frozen=True)
class MomentDrawing:
    """A moment, ready to be drawn.

    Attributes:
        floor: the map and the regions at that time, on the model's grid.
        pose: (x, y, heading) of the robot.
        hulls: closed outlines of tentative parts (K, 2) and whether each became a region.
        cuts: (M, 2, 2) segments along which the chosen part is cut off.
        chosen: which of the hulls is looked at.
    """

    floor: Picture
    pose: tuple[float, float, float]
    hulls: tuple[tuple[FloatArray, bool], ...]
    cuts: FloatArray
    chosen: int | None


def draw_moment(drawing: Drawing, step: int, chosen: int | None, theme: str) -> MomentDrawing:
    """The drawing of a step of the drive. Reads and paints pictures: call it in a thread.

    Args:
        drawing: of the model.
        step: from 0.
        chosen: the decision that is looked at.
        theme: "light" or "dark".

    Raises:
        ModelError: the picture of the step does not fit the map.
        IndexError: there is no such step.
    """
    moment, png = drawing.moments[step], drawing.step_pictures[step]
    layers = picture_on_map(png, moment, drawing.geometry)
    colours = {node.region: node.colour for node in drawing.nodes}
    decisions = moment["decisions"]
    hulls = tuple((np.array(d["hull"], float), bool(d["accepted"])) for d in decisions)
    cut = decisions[chosen]["cut"] if chosen is not None and chosen < len(decisions) else []
    x, y, heading = (float(v) for v in moment["pose"])
    floor = moment_picture(layers, colours, THEMES[theme])
    return MomentDrawing(floor, (x, y, heading), hulls, _segments(cut), chosen)


class MomentScene:
    """The moment in a client's scene; it only draws."""

    def __init__(self, canvas: Canvas) -> None:
        self._canvas = canvas

    def show(self, drawing: Drawing, moment: MomentDrawing) -> None:
        """Draws a moment over the floor."""
        canvas, geometry, size = self._canvas, drawing.geometry, drawing.mark_scale
        rows, cols = geometry.shape
        x, y = geometry.world_of(np.array([rows / 2 - 0.5, cols / 2 - 0.5])).tolist()
        extent = (cols * geometry.resolution, rows * geometry.resolution)
        heading = geometry.origin[2]
        canvas.image(f"{GROUP}/floor", moment.floor, extent, (x, y, FLOOR_LEVEL), heading)
        for name, wanted, colour in (("yes", True, ACCEPTED), ("no", False, REJECTED)):
            outlines = [_outline(h) for h, accepted in moment.hulls if accepted is wanted]
            self._lines(f"hulls/{name}", outlines, colour, HULL_WIDTH * size)
        chosen = () if moment.chosen is None else moment.hulls[moment.chosen : moment.chosen + 1]
        for name, wanted, colour in (("yes", True, ACCEPTED), ("no", False, REJECTED)):
            outlines = [_outline(h) for h, accepted in chosen if accepted is wanted]
            self._lines(f"chosen/{name}", outlines, colour, CHOSEN_WIDTH * size)
        cuts = _raised(moment.cuts, CUT_LEVEL)
        self._lines("cut", [cuts] if len(cuts) else [], CUT, CUT_WIDTH * size)

    def clear(self) -> None:
        """Takes the moment out."""
        self._canvas.remove(GROUP)

    def _lines(self, name: str, parts: Sequence[FloatArray], colour: Colour, width: float) -> None:
        path = f"{GROUP}/{name}"
        if parts:
            self._canvas.lines(path, np.concatenate(parts), colour, width)
        else:
            self._canvas.remove(path)


def _outline(hull: FloatArray) -> FloatArray:
    """(K, 2, 3) the sides of a closed outline (K, 2)."""
    return _raised(np.stack((hull, np.roll(hull, -1, axis=0)), axis=1), HULL_LEVEL)


def _segments(lines: Sequence[Sequence[Sequence[float]]]) -> FloatArray:
    parts = [np.stack((p[:-1], p[1:]), axis=1) for line in lines if len(p := np.array(line)) > 1]
    return np.concatenate(parts) if parts else np.zeros((0, 2, 2))


def _raised(segments: FloatArray, level: float) -> FloatArray:
    return np.concatenate((segments, np.full((*segments.shape[:2], 1), level)), axis=2)
