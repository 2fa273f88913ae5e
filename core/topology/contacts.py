"""Where regions touch: doorways."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from scipy.spatial.distance import pdist

from core.geometry import FloatArray, IntArray
from core.mapping import GridGeometry

BRIDGE = 2
"""Grids that may part two contact points of one stretch."""
PASSABLE = 0.3
"""Metres; a narrower stretch is a hole in a sonar map's wall rather than a doorway."""


@dataclass(frozen=True)
class Contact:
    """One stretch of contact of two regions `low < high`: middle (world x, y) and width (m)."""

    low: int
    high: int
    middle: tuple[float, float]
    width_m: float


def contacts(regions: IntArray, geometry: GridGeometry) -> tuple[Contact, ...]:
    """The stretches of contact that one can pass, one per pair of regions and place.

    Args:
        regions: (rows, cols) label image, 0 = none.
        geometry: where its cells lie.
    """
    points, pairs = _contact_points(regions)
    if len(points) == 0:
        return ()
    found = []
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    points, pairs = points[order], pairs[order]
    first = np.flatnonzero(np.any(np.diff(pairs, axis=0, prepend=-1) != 0, axis=1))
    for pair, mine in zip(pairs[first], np.split(points, first[1:]), strict=True):
        for stretch in _stretches(mine):
            centre = stretch[np.argmin(((stretch - stretch.mean(axis=0)) ** 2).sum(axis=1))]
            x, y = geometry.world_of(centre)
            extent = float(pdist(stretch).max()) if len(stretch) > 1 else 0.0
            width = (extent + 1) * geometry.resolution
            found.append(Contact(int(pair[0]), int(pair[1]), (float(x), float(y)), width))
    return _passable(tuple(found))


def _passable(found: tuple[Contact, ...]) -> tuple[Contact, ...]:
    """The stretches that one can pass, and narrower ones only where nothing else joins two parts."""
    parent = {value: value for contact in found for value in (contact.low, contact.high)}

    def root(value: int) -> int:
        while parent[value] != value:
            value = parent[value]
        return value

    kept = set()
    for i in sorted(range(len(found)), key=lambda i: -found[i].width_m):
        low, high = root(found[i].low), root(found[i].high)
        if found[i].width_m >= PASSABLE or low != high:
            kept.add(i)
            parent[high] = low
    return tuple(contact for i, contact in enumerate(found) if i in kept)


def _contact_points(regions: IntArray) -> tuple[FloatArray, IntArray]:
    """Middles between neighbouring grids of different regions, `[row, col]`, and the two regions."""
    points, pairs = [], []
    for axis in (0, 1):
        a = np.moveaxis(regions, axis, 0)[:-1]
        b = np.moveaxis(regions, axis, 0)[1:]
        where = np.argwhere((a > 0) & (b > 0) & (a != b))
        values = np.column_stack((a[tuple(where.T)], b[tuple(where.T)]))
        middle = where + np.array([0.5, 0.0])
        points.append(middle if axis == 0 else middle[:, ::-1])
        pairs.append(np.sort(values, axis=1))
    return np.concatenate(points).astype(float), np.concatenate(pairs).astype(np.int64)


def _stretches(points: FloatArray) -> list[FloatArray]:
    """Points (n, 2) parted into groups that hang together."""
    low = np.floor(points.min(axis=0)).astype(int)
    cells = np.floor(points).astype(int) - low
    image = np.zeros(cells.max(axis=0) + 1, bool)
    image[cells[:, 0], cells[:, 1]] = True
    image = np.pad(image, BRIDGE)
    near = ndimage.binary_dilation(image, np.ones((3, 3)), iterations=max(1, BRIDGE // 2))
    labels, count = ndimage.label(near, np.ones((3, 3)))
    mine = labels[cells[:, 0] + BRIDGE, cells[:, 1] + BRIDGE]
    return [points[mine == i] for i in range(1, count + 1)]
