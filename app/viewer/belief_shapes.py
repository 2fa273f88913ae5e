"""Where bars stand and how high they are, and the shapes of what belongs to a belief."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from app.viewer.contour_mesh import Mesh
from app.viewer.drawing import Drawing
from app.viewer.palette import Colour
from core.geometry import FloatArray, IntArray

BAR: Colour = (66, 133, 244)
BEST_BAR: Colour = (234, 67, 53)
UNKNOWN_BAR: Colour = (128, 136, 152)
BAR_SHARE = 2.3
"""Width of a bar against the radius of its node's sphere: seen from above it frames the sphere."""
FLOOR_LEVEL, LEAST_HEIGHT = 0.02, 0.03
UNKNOWN_WIDTH, UNKNOWN_DISTANCE, UNKNOWN_MARGIN = 0.4, 0.6, 0.8
"""Metres; then the distance of the bar of `unknown` from the home, and room for its name."""
LEAST_WIDTH_SHARE = 0.4
"""Of a bar of probability 0 against one of 1: from above, the area tells the probability."""
ARROW_THICKNESS = 0.16
"""Of an arrow of length 1."""


@dataclass(frozen=True)
class BarPlan:
    """Bars to draw.

    Attributes:
        feet: (N, 3) middle of each bar's lower side.
        scales: (N, 3) width, depth and height, metres.
        colours: of each bar.
        tells_unknown: whether the last bar is that of `unknown`.
    """

    FULL_HEIGHT: ClassVar[float] = 1.4
    """Metres of probability 1: just below the spheres, so that no bar covers a name."""

    feet: FloatArray
    scales: FloatArray
    colours: tuple[Colour, ...]
    tells_unknown: bool

    def on_the_way_from(self, earlier: BarPlan, share: float) -> BarPlan:
        """The bars between those of an earlier step (share 0) and these (1), eased."""
        if earlier.scales.shape != self.scales.shape:
            return self
        eased = share * share * (3 - 2 * share)
        return replace(self, scales=earlier.scales + eased * (self.scales - earlier.scales))


def plan_bars(
    drawing: Drawing, probabilities: Mapping[str, float], unknown: float | None
) -> BarPlan:
    """A bar where each node stands, as high as its probability (0..1); the greatest one in red.

    Nodes without a probability get none; probabilities of nodes that are not drawn are left out.
    """
    nodes = [node for node in drawing.nodes if node.id in probabilities]
    share = [probabilities[node.id] for node in nodes]
    feet = [(*node.centre[:2], FLOOR_LEVEL) for node in nodes]
    widths = [node.radius * BAR_SHARE for node in nodes]
    colours = [BAR] * len(nodes)
    if unknown is not None:
        share.append(unknown)
        feet.append((*unknown_spot(drawing), FLOOR_LEVEL))
        widths.append(UNKNOWN_WIDTH * drawing.mark_scale)
        colours.append(UNKNOWN_BAR)
    if share:
        colours[int(np.argmax(share))] = BEST_BAR
    shares = np.clip(np.array(share, float), 0.0, 1.0)
    heights = np.maximum(shares * BarPlan.FULL_HEIGHT, LEAST_HEIGHT)
    across = np.array(widths) * (LEAST_WIDTH_SHARE + (1 - LEAST_WIDTH_SHARE) * np.sqrt(shares))
    return BarPlan(
        np.array(feet, float).reshape(-1, 3),
        np.column_stack((across, across, heights)),
        tuple(colours),
        unknown is not None,
    )


def unknown_spot(drawing: Drawing) -> tuple[float, float]:
    """Where the bar of `unknown` stands (x, y): to the right of the home, at its lower edge."""
    (_, y), (x, _) = drawing.outline.min(axis=0).tolist(), drawing.outline.max(axis=0).tolist()
    away = UNKNOWN_DISTANCE * drawing.mark_scale
    return x + away, y + away


def with_unknown(drawing: Drawing) -> FloatArray:
    """(K, 2) outline of the home and of the bar of `unknown` beside it, for the camera."""
    (x, y), margin = unknown_spot(drawing), UNKNOWN_MARGIN * drawing.mark_scale
    return np.concatenate((drawing.outline, [(x - margin, y), (x + margin, y)]))


def evenly(count: int, most: int) -> IntArray:
    """(most,) indices into `count` things, evenly spread: always as many, repeated when few."""
    return np.linspace(0, count - 1, most).round().astype(np.int64)


def arrow() -> Mesh:
    """A flat arrowhead of length 1 along +x, turning about its middle, standing on z = 0."""
    outline = np.array([(0.55, 0.0), (-0.45, 0.38), (-0.22, 0.0), (-0.45, -0.38)])
    low = np.column_stack((outline, np.zeros(4)))
    high = np.column_stack((outline, np.full(4, ARROW_THICKNESS)))
    faces = [(4, 5, 6), (4, 6, 7), (0, 2, 1), (0, 3, 2)]
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
        faces += [(a, b, b + 4), (a, b + 4, a + 4)]
    vertices = np.concatenate((low, high))[np.array(faces).ravel()]
    corners = np.arange(len(vertices)).reshape(-1, 3)
    return Mesh(vertices.astype(np.float32), corners.astype(np.uint32))
