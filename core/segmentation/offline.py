"""Offline segmentation with a given number of regions (paper, 3.1)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from core.errors import InputError, MapError
from core.geometry import BoolArray, IntArray
from core.segmentation.cell_decomposition import affinity, decompose
from core.segmentation.connected import connect_regions, renumber
from core.segmentation.normalized_cut import KMeansConfig, normalized_cut

LARGEST_K = 500
"""Regions; a home has tens, and the eigensolver's time grows with the square of k."""


@dataclass(frozen=True)
class OfflineConfig:
    """Parameters of the offline cut: largest quadtree cell in grids (None as in the paper)."""

    max_cell: int | None = 32
    k_means: KMeansConfig = field(default_factory=KMeansConfig)


def segment_offline(
    free: BoolArray, k: int, seed: int = 0, config: OfflineConfig | None = None
) -> IntArray:
    """Cuts free space into k regions.

    Args:
        free: (rows, cols) connected free space.
        k: number of regions.
        seed: of k-means.
        config: parameters.

    Returns:
        (rows, cols) region 1..k of each grid, 0 outside.

    Raises:
        InputError: k is not between 1 and the number of cells.
        MapError: there is no free space.
    """
    config = config or OfflineConfig()
    if not free.any():
        raise MapError("the map has no free space to divide")
    cells = decompose(free, config.max_cell)
    most = min(len(cells), LARGEST_K)
    if not 1 <= k <= most:
        raise InputError(
            f"{k} regions cannot be made: choose a number from 1 to {most} for this map"
        )
    cluster = normalized_cut(affinity(cells), k, np.random.default_rng(seed), config.k_means)
    regions = np.where(cells.index >= 0, cluster[cells.index] + 1, 0)
    return renumber(connect_regions(regions))
