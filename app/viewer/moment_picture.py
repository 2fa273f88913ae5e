"""What a step of extraction looked like, as a picture on the floor: map, regions, tentative parts."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from app.viewer.floor_image import FloorTheme, Picture
from app.viewer.palette import PALETTE, Colour
from core.geometry import IntArray
from core.mapping.occupancy_grid import FREE, OCCUPIED
from core.segmentation.step_picture import StepPicture

MOST_PIXELS = 600_000
"""A picture of this size is sent in about a tenth of a second, so that a drive can be scrubbed."""
MOST_SCALE = 3
STRIPE = 5
"""Pixels across one stripe of a tentative part."""
FAINT = 0.45
"""Share of its colour that a stripe has."""


def moment_picture(step: StepPicture, colours: Mapping[int, Colour], theme: FloorTheme) -> Picture:
    """The picture of a step on the model's grid.

    Extracted regions have the full tint of the colour they have in the model (or one by their
    number when they are no longer in it), tentative parts are striped.

    Args:
        step: layers on the model's grid, row 0 at the bottom.
        colours: of the model's regions, by number.
        theme: of the floor.
    """
    rows, cols = step.state.shape
    scale = max(1, min(MOST_SCALE, int(np.sqrt(MOST_PIXELS / (rows * cols)))))
    state, regions, clusters = (
        np.asarray(layer, np.int64).repeat(scale, axis=0).repeat(scale, axis=1)
        for layer in (step.state, step.regions, step.clusters)
    )
    free = np.array(theme.free, np.float32)
    picture = np.zeros((*state.shape, 4), np.float32)
    picture[state == FREE] = (*theme.free, 255)
    for layer, share, shown in (
        (clusters, FAINT, _stripes(state.shape)),
        (regions, theme.tint, np.ones(state.shape, bool)),
    ):
        table = _table(layer, colours if layer is regions else {}, free, share)
        inside = (layer > 0) & (state == FREE) & shown
        picture[inside, :3] = table[layer[inside]]
    picture[state == OCCUPIED] = (*theme.occupied, 255)
    return picture.astype(np.uint8)


def _table(
    labels: IntArray, colours: Mapping[int, Colour], free: np.ndarray, share: float
) -> np.ndarray:
    """(n, 3) the floor's colour under each label."""
    numbers = np.arange(int(labels.max(initial=0)) + 1)
    own = np.array([colours.get(int(n), PALETTE[int(n) % len(PALETTE)]) for n in numbers])
    return np.asarray(free + share * (own - free), np.float32)


def _stripes(shape: tuple[int, ...]) -> np.ndarray:
    row, col = np.indices(shape)
    return np.asarray((row + col) // STRIPE % 2 == 0)
