"""Features of the border between two regions, from which the boundary model judges it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np
from scipy import ndimage

from core.geometry import FloatArray, IntArray
from core.segmentation.boundary_points import Pair, boundary_points
from core.segmentation.boundary_shape import BoundaryShape
from core.segmentation.convex_hull import convex_hull, polygon_area
from core.segmentation.map_character import MapCharacter

FEATURES = (
    "passage / largest disc of the smaller region (log)",
    "border / sqrt(area) of the smaller (log)",
    "border (log m)",
    "area of the smaller (log m2)",
    "largest disc of the smaller (log m)",
    "border / sqrt(area) of the larger (log)",
    "open share of the common border (the rest is wall)",
    "common wall (log m)",
    "longest stretch / border",
    "width 0.35 m off / stretch (log)",
    "width 0.7 m off / stretch (log)",
    "width 1.2 m off / stretch (log)",
    "width 0.7 m off on the wider side / stretch (log)",
    "largest disc within 0.75 m / passage (log)",
    "largest disc within 1.5 m / passage (log)",
    "jamb, lesser",
    "jamb, greater",
    "wall in line, lesser",
    "wall in line, greater",
    "hull of both / hulls of each (log)",
    "solidity of the less solid",
    "solidity of both",
    "area / disc of the smaller (log)",
    "area / disc of the larger (log)",
    "roughness of the border (m)",
    "overlap of the hulls",
    "bare passage / largest bare disc of the smaller (log)",
    "largest bare disc of the smaller (log m)",
    "bare passage (log m)",
    "wall in line far and wide (log m)",
    "wall in line far and wide / stretch (log)",
    "turned against the main walls",
    "walls flush with the ends, lesser side",
    "walls flush with the ends, greater side",
    "wall flush on both sides of an end",
    "share of all open borders of the smaller",
    "share of all open borders of the larger",
    "open share of the outline of the smaller",
    "open share of the outline of the larger",
    "neighbours of the smaller (log)",
    "neighbours of the larger (log)",
    "all open borders / sqrt(area) of the smaller (log)",
    "floor of the map (log m2)",
    "specks of the map (log per m2)",
    "furniture of the map (log share of the floor)",
)
WALL_THICKNESS = 0.6
"""Metres: two regions that a thicker obstacle parts have no wall in common."""
SMALL = 0.05
"""Metres: the least width that is told from none."""
LONG_BORDER = 0.85
"""Metres of a border per metre of its steps along rows and columns, on average."""
FEWEST_SPECKS, LEAST_FURNITURE = 0.02, 0.01
"""Per square metre, and share of the floor: what is told from none."""
HULL_OFFSET = 0.1
"""Square metres added to hulls, so that the smallest ones have an area."""


@dataclass(frozen=True)
class RegionShape:
    """A region.

    Attributes:
        area: square metres.
        depth: clearance at its deepest point (m).
        hull, hull_area: corners of its convex hull (cells) and the hull's area (m2).
        bare: the greatest clearance when furniture that stands alone is carried out (m).
    """

    area: float
    depth: float
    hull: FloatArray
    hull_area: float
    bare: float

    def joined(self, other: RegionShape, resolution: float) -> RegionShape:
        """The two regions as one."""
        hull, area = joint_hull(self, other, resolution)
        return RegionShape(
            self.area + other.area,
            max(self.depth, other.depth),
            hull,
            area,
            max(self.bare, other.bare),
        )


@dataclass(frozen=True)
class RegionOutline:
    """What a region is bounded by: metres open to its neighbours, metres of wall in common with
    other regions, and how many neighbours it is open to."""

    open: float
    wall: float
    neighbours: int

    @property
    def open_share(self) -> float:
        """Share of the outline that is open."""
        return self.open / (self.open + self.wall + 2 * SMALL)


def joint_hull(a: RegionShape, b: RegionShape, resolution: float) -> tuple[FloatArray, float]:
    """Hull of two regions (cells) and its area (m2)."""
    hull = convex_hull(np.concatenate((a.hull, b.hull)))
    return hull, polygon_area(hull) * resolution**2 + HULL_OFFSET


def region_shapes(
    cells: IntArray, clearance: FloatArray, bare: FloatArray, resolution: float
) -> dict[int, RegionShape]:
    """The shape of each label of an image (rows, cols), 0 = none, by its clearances (m)."""
    count = int(cells.max(initial=0)) + 1
    area = np.bincount(cells.ravel(), minlength=count) * resolution**2
    shapes = {}
    for value, box in enumerate(ndimage.find_objects(cells), start=1):
        if box is None:
            continue
        mask = cells[box] == value
        inner = ndimage.binary_erosion(mask, np.ones((3, 3)))
        points = np.argwhere(mask & ~inner) + np.array([box[0].start, box[1].start])
        hull = convex_hull(points.astype(float))
        hull_area = polygon_area(hull) * resolution**2 + HULL_OFFSET
        shapes[value] = RegionShape(
            float(area[value]),
            float(clearance[box][mask].max()),
            hull,
            hull_area,
            float(bare[box][mask].max()),
        )
    return shapes


def common_walls(
    cells: IntArray, touching: dict[Pair, FloatArray], resolution: float
) -> dict[Pair, float]:
    """Metres of wall between each two labels: the border that they would have without it.

    Args:
        cells: (rows, cols) label image, 0 = none.
        touching: its boundary points.
        resolution: metres per cell.
    """
    nearest = ndimage.distance_transform_edt(
        cells == 0, return_distances=False, return_indices=True
    )
    grown = cells.copy()
    _grow(grown, nearest, WALL_THICKNESS / 2, resolution)
    return {
        pair: max(0, len(points) - len(touching.get(pair, ()))) * resolution
        for pair, points in boundary_points(grown).items()
    }


@numba.njit(cache=True)
def _grow(cells, nearest, reach, resolution):  # type: ignore[no-untyped-def]
    """Gives cells without a label that of their nearest (2, rows, cols) with one within reach."""
    rows, cols = cells.shape
    for r in range(rows):
        for c in range(cols):
            row, col = nearest[0, r, c], nearest[1, r, c]
            squares = (row - r) ** 2 + (col - c) ** 2
            if squares > 0 and math.sqrt(squares) * resolution <= reach:
                cells[r, c] = cells[row, col]


def boundary_features(
    a: RegionShape,
    b: RegionShape,
    outlines: tuple[RegionOutline, RegionOutline],
    points: int,
    shape: BoundaryShape,
    wall: float,
    character: MapCharacter,
    resolution: float,
) -> list[float]:
    """The numbers that `FEATURES` names.

    Args:
        a, b: the regions.
        outlines: of both.
        points: number of boundary points between them.
        shape: the border's surroundings.
        wall: metres of common wall.
        character: of the whole map.
        resolution: metres per cell.
    """
    small, large = (a, b) if a.area <= b.area else (b, a)
    around_small, around_large = outlines if small is a else outlines[::-1]
    border = max(points * resolution * LONG_BORDER, shape.length)
    passage = max(shape.passage, SMALL)
    _, both = joint_hull(a, b, resolution)
    log, length = math.log, shape.length
    return [
        log(passage / (2 * min(a.depth, b.depth))),
        log(border / math.sqrt(small.area)),
        log(border),
        log(small.area),
        log(small.depth),
        log(border / math.sqrt(large.area)),
        border / (border + wall),
        log(wall + 2 * SMALL),
        length / border,
        log(max(shape.near_35, SMALL) / length),
        log(max(shape.near_70, SMALL) / length),
        log(max(shape.near_120, SMALL) / length),
        log(max(shape.wide_70, SMALL) / length),
        log(max(shape.open_75, SMALL) / passage),
        log(max(shape.open_150, SMALL) / passage),
        shape.jamb_low,
        shape.jamb_high,
        shape.wall_low,
        shape.wall_high,
        log(both / (a.hull_area + b.hull_area)),
        min(a.area / a.hull_area, b.area / b.hull_area),
        (a.area + b.area) / both,
        log(small.area / (4 * small.depth**2)),
        log(large.area / (4 * large.depth**2)),
        shape.roughness,
        max(0.0, a.hull_area + b.hull_area - both) / min(a.hull_area, b.hull_area),
        log(max(shape.bare_passage, SMALL) / (2 * min(a.bare, b.bare))),
        log(min(a.bare, b.bare)),
        log(max(shape.bare_passage, SMALL)),
        log(shape.wall_line + 0.1),
        log((shape.wall_line + 0.1) / length),
        shape.turned,
        shape.flush_low,
        shape.flush_high,
        shape.flush_line,
        points * resolution / around_small.open,
        points * resolution / around_large.open,
        around_small.open_share,
        around_large.open_share,
        log(around_small.neighbours),
        log(around_large.neighbours),
        log(around_small.open / math.sqrt(small.area)),
        log(character.area),
        log(character.specks + FEWEST_SPECKS),
        log(character.furniture + LEAST_FURNITURE),
    ]
