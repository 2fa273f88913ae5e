"""The direction of most walls of a map."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray

BLUR = 1.0
"""Standard deviation in cells: the staircase of a slanted wall becomes smooth."""


def main_axis(wall: BoolArray) -> float:
    """Direction of the walls (rows, cols) in radians, columns to rows, modulo a right angle.

    The mean of four times the gradient's angle, in which walls at right angles agree, weighted by
    the gradient's strength.
    """
    smooth = ndimage.gaussian_filter(wall.astype(float), BLUR)
    across, along = ndimage.sobel(smooth, 1), ndimage.sobel(smooth, 0)
    sloping = (across != 0) | (along != 0)
    gradient = across[sloping] + 1j * along[sloping]
    strength = np.maximum(np.abs(gradient), 1e-12)
    return float(np.angle((gradient**4 / strength**3).sum()) / 4)
