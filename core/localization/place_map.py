"""The features of a model that localization needs, computed once: places, ranges, nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from core.errors import ModelError
from core.geometry import IntArray
from core.localization.expected_range import ExpectedRangeConfig as RangeConfig
from core.localization.expected_range import ExpectedRanges, beam_codes, ray_codes
from core.localization.pose_grid import PoseGrid
from core.localization.pose_observation import Blocks, SonarTables, blocks_of
from core.localization.sonar_likelihood import SonarLikelihoodConfig, likelihood_table
from core.mapping.occupancy_grid import GridGeometry
from core.sensing import SonarRing
from core.topology import Model


@dataclass(frozen=True)
class PlaceMap:
    """Features of a map for localization.

    Attributes:
        rays: range codes of single rays from every place.
        grid: the poses that are told apart.
        blocks: the places in blocks.
        node_of: (rows, cols) index of the node whose region is nearest, for every place.
        nodes: node ids in the order of the indices.
        names: what people call the nodes (the label, else the id).
    """

    rays: ExpectedRanges
    grid: PoseGrid
    blocks: Blocks
    node_of: IntArray
    nodes: tuple[str, ...]
    names: tuple[str, ...]


def place_map(model: Model, ranges: RangeConfig, headings: int) -> PlaceMap:
    """The features of a model.

    Raises:
        ModelError: the model has no nodes or no free space.
    """
    rays = ray_codes(model.grid, ranges)
    nodes = model.topology.nodes
    if not nodes or not (model.regions > 0).any() or not rays.standable.any():
        raise ModelError("the model has no regions to be in; model the log again")
    grid = PoseGrid(rays.geometry, rays.standable, headings)
    index = {node.region: i for i, node in enumerate(nodes)}
    return PlaceMap(
        rays,
        grid,
        blocks_of(rays.standable),
        _nearest_node(model.regions, index, model.grid.geometry, rays.geometry),
        tuple(node.id for node in nodes),
        tuple(node.label or node.id for node in nodes),
    )


def _nearest_node(
    regions: IntArray, index: dict[int, int], fine: GridGeometry, places: GridGeometry
) -> IntArray:
    """Index of the node nearest to the centre of every place (rows, cols)."""
    lookup = np.full(int(regions.max()) + 1, -1, np.int64)
    for region, node in index.items():
        if 0 <= region < len(lookup):
            lookup[region] = node
    known = lookup[regions] >= 0
    known &= regions > 0
    if not known.any():
        raise ModelError("the nodes of topology.json have no cells in regions.png")
    nearest = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
    node_of = lookup[regions[nearest[0], nearest[1]]]
    rows, cols = np.mgrid[: places.shape[0], : places.shape[1]]
    cells = fine.cell_of(places.world_of(np.stack((rows, cols), axis=-1)))
    clipped = np.clip(cells, 0, np.array(fine.shape) - 1)
    return np.asarray(node_of[clipped[..., 0], clipped[..., 1]])


def sonar_tables(
    places: PlaceMap,
    ring: SonarRing,
    ranges: RangeConfig,
    likelihood: SonarLikelihoodConfig,
    broad: SonarLikelihoodConfig,
) -> tuple[tuple[SonarTables, ...], IntArray]:
    """The tables of every kind of sonar of a ring, and which kind each sonar is (S,)."""
    kinds: dict[tuple[float, float], int] = {}
    tables: list[SonarTables] = []
    kind_of_sonar = []
    for sonar in ring.sonars:
        key = (sonar.beam_width, sonar.max_range)
        if key not in kinds:
            kinds[key] = len(tables)
            nearest = beam_codes(places.rays, sonar.beam_width, ranges)
            codes = np.stack((nearest, places.rays.codes), axis=-1)
            standable = places.rays.standable
            tables.append(
                SonarTables(
                    codes,
                    likelihood_table(codes, standable, sonar.max_range, likelihood),
                    likelihood_table(codes, standable, sonar.max_range, broad),
                )
            )
        kind_of_sonar.append(kinds[key])
    return tuple(tables), np.array(kind_of_sonar, np.int64)
