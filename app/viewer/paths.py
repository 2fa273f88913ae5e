"""A drive as line segments, thinned and coloured from start to end."""

from __future__ import annotations

import numpy as np

from app.viewer.palette import Colour
from core.geometry import FloatArray

START_COLOUR: Colour = (250, 136, 74)
END_COLOUR: Colour = (186, 32, 20)


def thinned(poses: FloatArray, step: float) -> FloatArray:
    """Indices of poses (N, 3) at least `step` metres apart, with the first and the last."""
    if len(poses) == 0:
        return np.zeros(0, np.int64)
    keep = [0]
    for index in range(1, len(poses)):
        if np.hypot(*(poses[index, :2] - poses[keep[-1], :2])) >= step:
            keep.append(index)
    if keep[-1] != len(poses) - 1:
        keep.append(len(poses) - 1)
    return np.array(keep, np.int64)


def path_segments(poses: FloatArray, height: float, step: float = 0.05) -> FloatArray:
    """(M, 2, 3) segments of a drive at a height (m)."""
    flat = poses[thinned(poses, step), :2]
    line = np.column_stack((flat, np.full(len(flat), height)))
    return np.stack((line[:-1], line[1:]), axis=1) if len(line) > 1 else np.zeros((0, 2, 3))


def path_colours(count: int) -> FloatArray:
    """(count, 2, 3) uint8 colours that tell the direction of time."""
    share = np.linspace(0, 1, count + 1)[:, None]
    colours = np.array(START_COLOUR) + share * (np.array(END_COLOUR) - np.array(START_COLOUR))
    return np.stack((colours[:-1], colours[1:]), axis=1).astype(np.uint8)
