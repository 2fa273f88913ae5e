"""What a click in the 3D view meant: a ray -> a node, or a point on the floor."""

from __future__ import annotations

import numpy as np
from scipy import ndimage
from skimage.measure import find_contours

from app.viewer.drawing import Drawing
from core.geometry import FloatArray

NEAR_FLOOR = 0.3
"""Metres around a click on a wall's foot in which the nearest region is meant."""
_OUTLINE_BLUR, _OUTLINE_LEVEL = 1.4, 0.66
"""Cells, and the level of the blurred region that its outline follows: a little inside the walls."""
_GENEROUS = 1.25
"""A sphere is hit a little beyond its rim: fingers are thick."""


def floor_point(origin: FloatArray, direction: FloatArray) -> tuple[float, float] | None:
    """Where a ray meets z = 0 (world x, y), or None when it points away."""
    if abs(direction[2]) < 1e-9:
        return None
    travel = -origin[2] / direction[2]
    if travel <= 0:
        return None
    point = origin + travel * direction
    return float(point[0]), float(point[1])


def picked_node(drawing: Drawing, origin: FloatArray, direction: FloatArray) -> str | None:
    """The id of the node whose sphere a ray hits first, else of the region it meets on the floor."""
    hit = _hit_sphere(drawing, origin, direction)
    if hit is not None:
        return hit
    point = floor_point(origin, direction)
    return None if point is None else node_at(drawing, point)


def node_at(drawing: Drawing, point: tuple[float, float]) -> str | None:
    """The id of the node whose region is at, or very near, a world point."""
    geometry = drawing.geometry
    row, col = geometry.cell_of(point).tolist()
    reach = int(np.ceil(NEAR_FLOOR / geometry.resolution))
    r0, r1 = max(row - reach, 0), min(row + reach + 1, geometry.shape[0])
    c0, c1 = max(col - reach, 0), min(col + reach + 1, geometry.shape[1])
    if r0 >= r1 or c0 >= c1:
        return None
    window = drawing.regions[r0:r1, c0:c1]
    if not (window > 0).any():
        return None
    rows, cols = np.nonzero(window > 0)
    distance = np.hypot(rows + r0 - row, cols + c0 - col)
    nearest = int(np.argmin(distance))
    if distance[nearest] > reach:
        return None
    region = int(window[rows[nearest], cols[nearest]])
    return next((node.id for node in drawing.nodes if node.region == region), None)


def region_outline(drawing: Drawing, region: int, height: float) -> FloatArray:
    """(M, 2, 3) segments just inside a region's border, its corners cut, at a height (m)."""
    rows, cols = np.nonzero(drawing.regions == region)
    if len(rows) == 0:
        return np.zeros((0, 2, 3))
    low = np.array([rows.min(), cols.min()]) - 4
    high = np.array([rows.max(), cols.max()]) + 5
    window = np.zeros(high - low, bool)
    window[rows - low[0], cols - low[1]] = True
    field = ndimage.gaussian_filter(window.astype(float), _OUTLINE_BLUR)
    pieces = []
    contours: list[FloatArray] = find_contours(field, _OUTLINE_LEVEL)  # type: ignore[no-untyped-call]
    for contour in contours:
        world = drawing.geometry.world_of(contour + low)
        line = np.column_stack((world, np.full(len(world), height)))
        pieces.append(np.stack((line[:-1], line[1:]), axis=1))
    return np.concatenate(pieces) if pieces else np.zeros((0, 2, 3))


def _hit_sphere(drawing: Drawing, origin: FloatArray, direction: FloatArray) -> str | None:
    if not drawing.nodes:
        return None
    unit = direction / np.linalg.norm(direction)
    centres = np.array([node.centre for node in drawing.nodes]) - origin
    along = centres @ unit
    miss = np.linalg.norm(centres - along[:, None] * unit, axis=1)
    radii = np.array([node.radius for node in drawing.nodes]) * _GENEROUS
    hit = np.flatnonzero((miss <= radii) & (along > 0))
    if len(hit) == 0:
        return None
    return drawing.nodes[int(hit[np.argmin(along[hit])])].id
