"""From a belief over poses to a belief over nodes, and the best place in every node."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.geometry import FloatArray
from core.localization.place_map import PlaceMap
from core.localization.pose_grid import MassArray, PoseBelief, PoseGrid


@dataclass(frozen=True)
class NodeBeliefConfig:
    """How poses become nodes.

    Attributes:
        map_sigma: standard deviation in metres of where the map itself has things: drift of the
            mapping drive. A robot this close to a border may be on either side of it, however sure
            its pose in the map. Chosen on simulated homes.
        peak: cells around the best pose of a node that its mean is taken over,
        peak_headings: and headings.
    """

    map_sigma: float = 0.10
    peak: int = 3
    peak_headings: int = 2


def node_probabilities(
    belief: PoseBelief, places: PlaceMap, config: NodeBeliefConfig
) -> FloatArray:
    """Probability of every node (n,); with `belief.unknown` they sum to 1."""
    here = belief.mass.sum(axis=0, dtype=np.float64)
    sigma = config.map_sigma / places.grid.geometry.resolution
    spread = ndimage.gaussian_filter(here, sigma, mode="constant") * places.grid.standable
    mass = np.bincount(places.node_of.ravel(), spread.ravel(), minlength=len(places.nodes))
    total = mass.sum()
    if total <= 0:
        return np.full(len(places.nodes), (1 - belief.unknown) / len(places.nodes))
    return np.asarray(mass * (1 - belief.unknown) / total)


def best_poses(belief: PoseBelief, places: PlaceMap, config: NodeBeliefConfig) -> FloatArray:
    """The most probable pose in each node: (n, 3) world poses; NaN where a node has no place."""
    highest = belief.mass.max(axis=0)
    poses = np.full((len(places.nodes), 3), np.nan)
    for node in range(len(places.nodes)):
        inside = (places.node_of == node) & places.grid.standable
        if inside.any():
            cell = int(np.where(inside, highest, -1.0).argmax())
            row, col = divmod(cell, highest.shape[1])
            poses[node] = _peak_pose(belief.mass, places.grid, row, col, config)
    return poses


def _peak_pose(
    mass: MassArray, grid: PoseGrid, row: int, col: int, config: NodeBeliefConfig
) -> FloatArray:
    """The mean pose of the peak around a cell's best heading."""
    heading = int(mass[:, row, col].argmax())
    turns = np.arange(-config.peak_headings, config.peak_headings + 1)
    rows = np.arange(max(0, row - config.peak), min(mass.shape[1], row + config.peak + 1))
    cols = np.arange(max(0, col - config.peak), min(mass.shape[2], col + config.peak + 1))
    peak = mass[np.ix_((heading + turns) % grid.headings, rows, cols)].astype(float)
    total = peak.sum()
    if not total > 0 or not math.isfinite(total):
        return grid.world_pose(heading, row, col)
    return grid.world_pose(
        heading + float((peak.sum(axis=(1, 2)) * turns).sum() / total),
        float((peak.sum(axis=(0, 2)) * rows).sum() / total),
        float((peak.sum(axis=(0, 1)) * cols).sum() / total),
    )
