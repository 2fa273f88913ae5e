"""Dividing a part of the free space into convex parts: cut in two until convex, then join again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.geometry import BoolArray, IntArray
from core.segmentation.convex_join import convex_groups
from core.segmentation.convex_split import ConvexSplitConfig, split_until_convex


@dataclass(frozen=True)
class DivisionConfig:
    """Parameters of the division.

    Attributes:
        most_hidden: share of hidden pairs that a part may have (the paper's c_t is .2). Sonar maps
            hold specks that hide what the home does not: .23 on the map is under .2 in the home.
        pairs: pairs that are drawn.
        least_area: square metres; no part is cut smaller.
        least_border: metres along which two parts must touch to be joined: doorways stay.
    """

    most_hidden: float = 0.23
    pairs: int = 1000
    least_area: float = 1.5
    least_border: float = 1.0


def divided(
    space: BoolArray, blocked: BoolArray, resolution: float, config: DivisionConfig
) -> IntArray:
    """Label image (rows, cols) of the convex parts 1..n of a space, 0 outside.

    Args:
        space: what is divided; its pieces are divided one by one.
        blocked: what nobody sees through.
        resolution: metres per cell.
        config: parameters.
    """
    labels = np.zeros(space.shape, np.int64)
    if not space.any():
        return labels
    box = ndimage.find_objects(space.astype(np.int64))[0]
    split = ConvexSplitConfig(config.most_hidden, config.pairs, config.least_area)
    pieces, count = ndimage.label(space[box])
    parts = [
        part
        for piece in range(1, count + 1)
        for part in split_until_convex(pieces == piece, blocked[box], resolution, split, [])
    ]
    border = round(config.least_border / resolution)
    groups = convex_groups(parts, blocked[box], config.most_hidden, config.pairs, border)
    for number, group in enumerate(groups):
        for i in group:
            labels[box][parts[i]] = number + 1
    return labels
