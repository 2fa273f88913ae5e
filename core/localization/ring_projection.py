"""Ring projection: a neighbourhood as the share of occupied grids in each ring (eq. 10-11)."""

from __future__ import annotations

import numpy as np
from scipy import fft

from core.geometry import BoolArray, FloatArray, IntArray

FLAT = 1e-12
"""Variance below which a vector has no shape to be correlated."""


def ring_of_offsets(radius: int) -> IntArray:
    """Ring r of every offset in a square (2R + 1, 2R + 1): r <= distance < r + 1; -1 outside R."""
    steps = np.arange(-radius, radius + 1)
    ring = np.floor(np.hypot(steps[:, None], steps[None, :])).astype(np.int64)
    return np.where(ring <= radius, ring, -1)


def ring_vector(occupied: BoolArray, centre: tuple[int, int], radius: int) -> FloatArray:
    """P(r) of eq. (10) around a cell: (R + 1,). Cells outside the grid count as not occupied."""
    ring = ring_of_offsets(radius)
    patch = np.zeros(ring.shape, bool)
    rows, cols = np.nonzero(occupied)
    rows, cols = rows - centre[0] + radius, cols - centre[1] + radius
    near = (rows >= 0) & (cols >= 0) & (rows <= 2 * radius) & (cols <= 2 * radius)
    patch[rows[near], cols[near]] = True
    inside = ring >= 0
    hits = np.bincount(ring[inside & patch], minlength=radius + 1)
    return np.asarray(hits / np.bincount(ring[inside], minlength=radius + 1))  # eq. (10)


def ring_vectors(occupied: BoolArray, cells: IntArray, radius: int) -> FloatArray:
    """P(r) around many cells (N, 2) at once: (N, R + 1), by one convolution a ring."""
    ring = ring_of_offsets(radius)
    shape = tuple(fft.next_fast_len(n + 2 * radius, real=True) for n in occupied.shape)
    grid = fft.rfft2(occupied.astype(np.float32), shape)
    out = np.empty((len(cells), radius + 1), np.float32)
    for r in range(radius + 1):
        members = (ring == r).astype(np.float32)
        counts = fft.irfft2(grid * fft.rfft2(members, shape), shape)
        near = counts[cells[:, 0] + radius, cells[:, 1] + radius]
        out[:, r] = np.round(near) / members.sum()
    return out.astype(float)


def correlation(template: FloatArray, places: FloatArray) -> FloatArray:
    """rho of eq. (11) between a vector (R + 1,) and many (N, R + 1): (N,) in -1..1.

    A vector without shape (all rings alike) correlates with nothing: 0.
    """
    t = template - template.mean()
    o = places - places.mean(axis=1, keepdims=True)
    scale = (t @ t) * (o * o).sum(axis=1)
    return np.asarray(np.where(scale > FLAT, o @ t / np.sqrt(np.maximum(scale, FLAT)), 0.0))
