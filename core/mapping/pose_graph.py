"""A sparse pose graph: nodes along the drive, odometry between neighbours, closures between any two.

Gauss-Newton on the poses and, at the same time, on four unknowns that all nodes share: the three
systematic errors of the odometry (a closure then not only shifts the poses, it calibrates the robot) and
the direction of the building's walls. Closures and wall directions count by the Geman-McClure kernel, so
that a wrong one that slipped through loses its weight.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import SuperLU, splu

from core.geometry import FloatArray, IntArray, between, compose, wrap_angle
from core.mapping.graph_terms import (
    Entries,
    Link,
    PointLinks,
    point_entries,
    residuals,
    wall_entries,
)
from core.mapping.odometry_model import OdometryNoise, without_systematic_error
from core.mapping.wall_direction import wrap_quarter

SHARED = 4
"""Unknowns that all nodes share: three systematic errors and the direction of the walls."""
ACROSS = 0.3
"""Sideways error of a stretch per metre and radian of its heading error (1 / sqrt 12 if it grows evenly)."""
COLUMNS = 256
"""Columns of the inverse computed at a time."""


@dataclass(frozen=True)
class GraphConfig:
    """Parameters of the solver.

    Attributes:
        kernel: squared Mahalanobis distance at which a closure's weight has fallen to a quarter.
        wall_sigma: standard deviation of a node's wall direction (rad). Neighbouring nodes see the same
            walls: wider than the error of one.
        anchor_weight: information with which the first pose is held.
        tolerance: a step smaller than this (m, rad) ends the iterations.
        difference: step of the numerical derivative by the systematic errors.
    """

    kernel: float = 9.0
    wall_sigma: float = math.radians(2.5)
    anchor_weight: float = 1e8
    tolerance: float = 1e-4
    difference: float = 1e-4


@dataclass
class PoseGraph:
    """The graph and its current solution.

    Attributes:
        odometry: (N, 3) poses of the log.
        nodes: (K,) scan indices.
        noise: of the odometry, before the log.
        poses: (k, 3) solution of the nodes reached so far, k <= K.
        error: (3,) systematic error so far.
        walls: direction of the walls in the frame of a node, where it is known.
        wall_heading: direction of the building's walls in the map.
        links: the closures.
    """

    odometry: FloatArray
    nodes: IntArray
    noise: OdometryNoise
    config: GraphConfig = field(default_factory=GraphConfig)

    def __post_init__(self) -> None:
        self.poses = self.odometry[self.nodes[:1]].copy()
        self.error = np.array(self.noise.expected)
        self.links: list[Link] = []
        self.link_weights = np.zeros(0)
        self.walls: dict[int, float] = {}
        self.wall_heading = 0.0
        self.point_links: PointLinks | None = None
        self._factor: SuperLU | None = None
        self._measure()

    def __getstate__(self) -> dict[str, Any]:
        """Everything but the factor of the system, which cannot be kept: solve again after loading."""
        return self.__dict__ | {"_factor": None}

    def lengthen(self, odometry: FloatArray, nodes: IntArray) -> None:
        """Takes in more of the drive; what was there before stays its beginning."""
        self.odometry, self.nodes = odometry, nodes
        self._measure()

    def restart(self, error: FloatArray, wall_heading: float) -> None:
        """Takes over what another graph of the same drive found about the shared unknowns."""
        self.error = error.copy()
        self.wall_heading = wall_heading
        self._linearise()

    def extend(self) -> None:
        """Adds the next node where the odometry, as calibrated so far, puts it."""
        k = len(self.poses)
        self.poses = np.vstack((self.poses, compose(self.poses[-1], self.motion[k - 1])))

    def solve(self, iterations: int = 10) -> None:
        """Gauss-Newton from the current solution."""
        for _ in range(iterations):
            system, right = self._system()
            self._factor = splu(system, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
            step = self._factor.solve(right)
            count = 3 * len(self.poses)
            self.poses = self.poses + step[:count].reshape(-1, 3)
            self.poses[:, 2] = wrap_angle(self.poses[:, 2])
            self.error = self.error + step[count : count + 3]
            self.wall_heading = float(wrap_quarter(self.wall_heading + step[-1]))
            self.motion = self._motion(self.error)
            if float(np.abs(step).max()) < self.config.tolerance:
                break
        self._linearise()

    def relative_covariance(self, pairs: list[tuple[int, int]]) -> FloatArray:
        """(P, 3, 3) covariance of the second node's pose in the frame of the first, for each pair."""
        if self._factor is None:
            raise RuntimeError("solve first")
        size = 3 * len(self.poses) + SHARED
        source = np.array([p[0] for p in pairs], np.int64)
        target = np.array([p[1] for p in pairs], np.int64)
        _, at_source, at_target = residuals(self.poses, source, target, np.zeros((len(pairs), 3)))
        rows = np.zeros((len(pairs), 3, size))
        for p in range(len(pairs)):
            rows[p, :, 3 * source[p] : 3 * source[p] + 3] = at_source[p]
            rows[p, :, 3 * target[p] : 3 * target[p] + 3] = at_target[p]
        flat = rows.reshape(-1, size)
        solved = self._factor.solve(np.ascontiguousarray(flat.T)).T.reshape(len(pairs), 3, size)
        return np.asarray(np.einsum("pis,pjs->pij", rows, solved))

    def pose_sigma(self) -> FloatArray:
        """(k, 3) standard deviations of the poses against the first one."""
        count = len(self.poses)
        if self._factor is None:
            return np.zeros((count, 3))
        variance = np.empty(3 * count)
        for start in range(0, 3 * count, COLUMNS):
            stop = min(start + COLUMNS, 3 * count)
            unit = np.zeros((3 * count + SHARED, stop - start))
            unit[np.arange(start, stop), np.arange(stop - start)] = 1.0
            solved = self._factor.solve(unit)
            variance[start:stop] = solved[np.arange(start, stop), np.arange(stop - start)]
        return np.asarray(np.sqrt(np.maximum(variance, 0.0)).reshape(-1, 3))

    def error_sigma(self) -> FloatArray:
        """(3,) standard deviations of the systematic errors."""
        if self._factor is None:
            return self.noise.systematic
        size = 3 * len(self.poses) + SHARED
        unit = np.zeros((size, 3))
        unit[-SHARED:-1] = np.eye(3)
        return np.sqrt(np.maximum(np.diag(self._factor.solve(unit)[-SHARED:-1]), 0.0))

    def odometry_sigma(self) -> FloatArray:
        """(k - 1, 3) standard deviations of the random errors of the odometry links."""
        distance = self.distance[: len(self.poses) - 1]
        turned = self.turned[: len(self.poses) - 1]
        root = np.sqrt(distance + self.noise.metres_per_radian * turned)
        heading = self.noise.heading * root + self.noise.heading_floor
        position = self.noise.position * root + self.noise.position_floor
        across = position + ACROSS * distance * heading
        sigma = np.stack((position, across, heading), axis=1)
        return np.asarray(sigma)

    def odometry_residuals(self) -> FloatArray:
        """(k - 1, 3) what the solution changes at each odometry link beyond the systematic error."""
        k = np.arange(len(self.poses) - 1)
        residual, _, _ = residuals(self.poses, k, k + 1, self.motion[: len(k)])
        return residual

    def _measure(self) -> None:
        """Lengths, turns and motions between all nodes."""
        steps = np.hypot(*np.diff(self.odometry[:, :2], axis=0).T)
        total = np.concatenate(([0.0], np.cumsum(steps)))
        self.distance = np.diff(total[self.nodes])
        turns = np.abs(wrap_angle(np.diff(self.odometry[:, 2])))
        self.turned = np.diff(np.concatenate(([0.0], np.cumsum(turns)))[self.nodes])
        self._linearise()

    def _linearise(self) -> None:
        """Motions between all nodes at the current systematic error, and their derivatives."""
        self.motion = self._motion(self.error)
        step = self.config.difference
        self.by_error = np.stack(
            [(self._motion(self.error + step * unit) - self.motion) / step for unit in np.eye(3)],
            axis=2,
        )

    def _motion(self, error: FloatArray) -> FloatArray:
        poses = without_systematic_error(self.odometry, error)[self.nodes]
        return between(poses[:-1], poses[1:])

    def _system(self) -> tuple[sparse.csc_matrix, FloatArray]:
        """Normal equations of the poses and the systematic errors."""
        count = len(self.poses)
        chain = np.arange(count - 1)
        source = np.concatenate((chain, [link.source for link in self.links])).astype(np.int64)
        target = np.concatenate((chain + 1, [link.target for link in self.links])).astype(np.int64)
        measured = np.concatenate(
            (self.motion[: count - 1], np.array([link.pose for link in self.links]).reshape(-1, 3))
        )
        residual, at_source, at_target = residuals(self.poses, source, target, measured)
        information = np.zeros((len(source), 3, 3))
        k = np.arange(3)
        information[: count - 1, k, k] = 1 / self.odometry_sigma() ** 2
        if self.links:
            info = np.array([link.information for link in self.links])
            closing = residual[count - 1 :]
            distance = np.einsum("ei,eij,ej->e", closing, info, closing)
            by_person = np.array([link.by_person for link in self.links])
            weights = 1 / (1 + distance / self.config.kernel) ** 2
            self.link_weights = np.where(by_person, 1.0, weights)
            information[count - 1 :] = info * self.link_weights[:, None, None]
        at_error = np.zeros((len(source), 3, 3))
        at_error[: count - 1] = -self.by_error[: count - 1]
        return self._assemble(
            source, target, residual, (at_source, at_target, at_error), information
        )

    def _assemble(
        self,
        source: IntArray,
        target: IntArray,
        residual: FloatArray,
        blocks: tuple[FloatArray, FloatArray, FloatArray],
        information: FloatArray,
    ) -> tuple[sparse.csc_matrix, FloatArray]:
        count = len(self.poses)
        size = 3 * count + SHARED
        columns = [source, target, np.full(len(source), count)]
        k = np.arange(3)
        rows_, cols_, values = [], [], []
        right = np.zeros(size)
        for a, block_a in zip(columns, blocks, strict=True):
            weighted = np.einsum("eji,ejk->eik", block_a, information)
            gradient = np.einsum("eij,ej->ei", weighted, residual)
            np.add.at(right, (3 * a[:, None] + k).ravel(), -gradient.ravel())
            for b, block_b in zip(columns, blocks, strict=True):
                product = np.einsum("eij,ejk->eik", weighted, block_b)
                rows_.append(
                    np.broadcast_to((3 * a[:, None] + k)[:, :, None], product.shape).ravel()
                )
                cols_.append(
                    np.broadcast_to((3 * b[:, None] + k)[:, None, :], product.shape).ravel()
                )
                values.append(product.ravel())
        prior = 1 / self.noise.systematic**2
        shared = 3 * count + k
        rows_ += [k, shared]
        cols_ += [k, shared]
        values += [np.full(3, self.config.anchor_weight), prior]
        right[shared] -= prior * (self.error - np.array(self.noise.expected))
        for row, col, value in self._unary_and_points(right):
            rows_.append(row)
            cols_.append(col)
            values.append(value)
        system = sparse.coo_matrix(
            (np.concatenate(values), (np.concatenate(rows_), np.concatenate(cols_))), (size, size)
        ).tocsc()
        return system, right

    def _unary_and_points(self, right: FloatArray) -> list[Entries]:
        """Entries by the wall directions and the point pairs."""
        entries = wall_entries(
            self.poses,
            self.walls,
            self.wall_heading,
            self.config.wall_sigma,
            self.config.kernel,
            right,
        )
        if self.point_links is not None:
            entries += point_entries(self.poses, self.point_links, right)
        return entries
