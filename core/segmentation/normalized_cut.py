"""Normalized graph cut (paper, 3.1.2; Shi and Malik 2000; Ng, Jordan and Weiss 2002)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.cluster.vq import ClusterError, kmeans2
from scipy.sparse.linalg import eigsh

from core.geometry import FloatArray, IntArray

DENSE_BELOW = 64
"""Vertices; below, a dense eigensolver is as fast and never fails to converge."""
SHIFT = -1e-3
"""Shift of the inverse iteration: just below the smallest eigenvalue, which is 0."""


@dataclass(frozen=True)
class KMeansConfig:
    """k-means of step 5: the best of several starts (k-means++)."""

    starts: int = 10
    iterations: int = 100


def normalized_cut_value(weights: sparse.csr_array, cluster: IntArray) -> float:
    """Ncut of eq. (1), summed over all clusters present.

    Args:
        weights: (n, n) affinity W.
        cluster: (n,) cluster of each vertex.
    """
    degree = np.asarray(weights.sum(axis=1)).ravel()
    coo = weights.tocoo()
    crossing = cluster[coo.row] != cluster[coo.col]
    cut = np.bincount(cluster[coo.row[crossing]], coo.data[crossing], minlength=cluster.max() + 1)
    volume = np.bincount(cluster, degree, minlength=cluster.max() + 1)
    return float((cut[volume > 0] / volume[volume > 0]).sum())


def smallest_eigenvectors(weights: sparse.csr_array, k: int) -> FloatArray:
    """U of steps 2 and 3: (n, k) eigenvectors of L = D^-1/2 (D - W) D^-1/2 to the k smallest values.

    The sign of each is fixed (largest entry positive), so that the result is deterministic.
    """
    n = weights.shape[0]
    degree = np.asarray(weights.sum(axis=1)).ravel()
    scale = 1 / np.sqrt(np.where(degree > 0, degree, 1.0))
    laplacian = sparse.eye_array(n) - sparse.diags_array(scale) @ weights @ sparse.diags_array(
        scale
    )
    if n <= max(DENSE_BELOW, k + 1):
        vectors = np.linalg.eigh(laplacian.toarray())[1][:, :k]
    else:
        start = np.sqrt(np.where(degree > 0, degree, 1.0))
        values, found = eigsh(laplacian.tocsc(), k, sigma=SHIFT, v0=start + np.arange(n) / n)
        vectors = found[:, np.argsort(values)]
    largest = vectors[np.abs(vectors).argmax(axis=0), np.arange(vectors.shape[1])]
    return np.asarray(vectors * np.where(largest < 0, -1.0, 1.0))


def normalized_cut(
    weights: sparse.csr_array,
    k: int,
    rng: np.random.Generator,
    config: KMeansConfig | None = None,
) -> IntArray:
    """Steps 1-6: the cluster 0..k-1 of each vertex.

    Step 4 is row normalisation to unit L2 norm; the printed formula lacks the square under its root.

    Args:
        weights: (n, n) symmetric affinity of a connected graph (step 1).
        k: number of clusters, 1 <= k <= n.
        rng: for the starts of k-means.
        config: k-means.
    """
    config = config or KMeansConfig()
    n = weights.shape[0]
    if k >= n:
        return np.arange(n)
    if k == 1:
        return np.zeros(n, np.int64)
    u = smallest_eigenvectors(weights, k)
    rows = u / np.maximum(np.linalg.norm(u, axis=1, keepdims=True), 1e-12)  # step 4
    best, least = np.zeros(n, np.int64), np.inf
    for _ in range(config.starts):
        try:
            centres, cluster = kmeans2(
                rows, k, config.iterations, minit="++", missing="raise", rng=rng
            )
        except ClusterError:
            continue
        distortion = float(((rows - centres[cluster]) ** 2).sum())
        if distortion < least:
            best, least = cluster.astype(np.int64), distortion
    return best
