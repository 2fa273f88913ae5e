"""Labels that spread over the floor around them."""

from __future__ import annotations

from scipy import ndimage

from core.geometry import BoolArray, IntArray


def grown(labels: IntArray, free: BoolArray, steps: int) -> IntArray:
    """Labels (rows, cols) spread over unlabelled free cells, a cell a step, never through walls."""
    labels = labels.copy()
    for _ in range(steps):
        spread = ndimage.grey_dilation(labels, footprint=ndimage.generate_binary_structure(2, 1))
        new = free & (labels == 0) & (spread > 0)
        if not new.any():
            break
        labels[new] = spread[new]
    return labels
