"""The reliable region of a local grid map (paper, 3.2.1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy import ndimage
from skimage.draw import polygon

from core.geometry import BoolArray, FloatArray, IntArray
from core.mapping import OccupancyGrid
from core.segmentation.boundary_tracing import trace_boundary


@dataclass(frozen=True)
class ReliableConfig:
    """Open points of eq. (6).

    Attributes:
        threshold: "mean" as printed: the mean confidence of the occupied grids; near grids dominate
            it (1/r^2), and the contour cuts wedges through walls. "percentile": a low percentile,
            which works.
        percentile: that percentile.
    """

    threshold: Literal["mean", "percentile"] = "percentile"
    percentile: float = 15.0


def confident_grids(
    confidence: FloatArray, occupied: BoolArray, config: ReliableConfig | None = None
) -> BoolArray:
    """Which occupied grids (rows, cols) are regarded as truly occupied."""
    config = config or ReliableConfig()
    if not occupied.any():
        return np.zeros_like(occupied)
    values = confidence[occupied]
    limit = (
        values.mean() if config.threshold == "mean" else np.percentile(values, config.percentile)
    )
    return occupied & (confidence > limit)  # eq. (6)


def reliable_region(
    grid: OccupancyGrid,
    confidence: FloatArray,
    seed: IntArray,
    config: ReliableConfig | None = None,
) -> BoolArray:
    """Free grids (rows, cols) inside the contour that joins the confident boundary grids.

    Args:
        grid: the local map.
        confidence: Conf of eq. (5), (rows, cols).
        seed: (2,) a free cell; the free space around it is taken.
        config: open points.
    """
    pieces, _ = ndimage.label(grid.free)
    here = (pieces == pieces[tuple(seed)]) & grid.free
    if not here.any():
        return np.zeros_like(here)
    boundary = trace_boundary(ndimage.binary_dilation(here, np.ones((3, 3))))
    # Joined in tracing order.
    certain = confident_grids(confidence, grid.occupied, config)
    corners = boundary[certain[boundary[:, 0], boundary[:, 1]]]
    if len(corners) < 3:
        return np.zeros_like(here)
    inside = np.zeros_like(here)
    inside[polygon(corners[:, 0], corners[:, 1], here.shape)] = True  # type: ignore[no-untyped-call]
    reliable, _ = ndimage.label(here & inside)
    if reliable[tuple(seed)] == 0:
        return np.zeros_like(here)
    return np.asarray(reliable == reliable[tuple(seed)])
