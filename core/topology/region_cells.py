"""The cells of many regions, each looked for within its bounding box: a large map is read once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from scipy import ndimage

from core.geometry import IntArray


def region_cells(regions: IntArray, values: Iterable[int]) -> Iterator[IntArray]:
    """Cells `[row, col]` (n, 2) of each of these regions of a label image (rows, cols) in turn."""
    boxes = ndimage.find_objects(regions)
    for value in values:
        box = boxes[value - 1] if 1 <= value <= len(boxes) else None
        if box is None:
            yield np.zeros((0, 2), np.int64)
        else:
            yield np.argwhere(regions[box] == value) + np.array([box[0].start, box[1].start])
