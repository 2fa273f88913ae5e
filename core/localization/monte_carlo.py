"""Monte Carlo localization with a likelihood field, the peer that the others are measured against.

Thrun, Burgard and Fox (2005): sample odometry motion, end-point likelihood field (Sect. 6.4),
low-variance resampling (Sect. 4.3.4) and random particles when the fit drops (Sect. 8.3.3).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy import ndimage

from core.geometry import FloatArray, between, compose, wrap_angle
from core.localization.entropy_test import entropy_of
from core.localization.expected_range import ExpectedRangeConfig
from core.localization.explanation import explain
from core.localization.localization_step import Candidate, LocalizationStep
from core.localization.place_map import PlaceMap, place_map
from core.localization.pose_motion import PoseMotionConfig
from core.localization.segment import Segment, SegmentConfig, segment_of
from core.sensing import RobotLog, SonarRing
from core.topology import Model


@dataclass(frozen=True)
class MonteCarloConfig:
    """Parameters of the particle filter; motion noise is the default method's.

    Attributes:
        particles: how many.
        sigma: of the likelihood field, metres.
        hit, random: shares of echoes from an obstacle and of any other.
        temper: exponent of the likelihood of one scan.
        resample_below: share of effective particles below which they are drawn anew.
        slow, fast: rates of the averages whose ratio tells how many random particles are needed.
    """

    particles: int = 10_000
    sigma: float = 0.2
    hit: float = 0.8
    random: float = 0.2
    temper: float = 0.3
    resample_below: float = 0.5
    slow: float = 0.05
    fast: float = 0.3
    motion: PoseMotionConfig = field(default_factory=PoseMotionConfig)
    segment: SegmentConfig = field(default_factory=SegmentConfig)


@dataclass(frozen=True)
class Particles:
    """Poses (M, 3) with weights (M,), and the running averages of the fit."""

    poses: FloatArray
    weights: FloatArray
    slow: float = 0.0
    fast: float = 0.0
    steps: int = 0


class MonteCarloLocalizer:
    """Monte Carlo localization for one model and one sonar ring."""

    def __init__(
        self, model: Model, ring: SonarRing, config: MonteCarloConfig | None = None, seed: int = 0
    ) -> None:
        self.config = config or MonteCarloConfig()
        self.ring = ring
        self.seed = seed
        self.places: PlaceMap = place_map(model, ExpectedRangeConfig(), headings=72)
        self.geometry = model.grid.geometry
        self.free = np.argwhere(model.grid.free)
        self.is_free = model.grid.free
        occupied = model.grid.occupied
        far = (
            ndimage.distance_transform_edt(~occupied)
            if occupied.any()
            else np.full(occupied.shape, 1e3)
        )
        distance = far * self.geometry.resolution
        field_ = np.exp(-0.5 * (distance / self.config.sigma) ** 2)
        self.log_field = np.log(self.config.hit * field_ + self.config.random)
        self.log_outside = math.log(self.config.random)

    def start(self) -> Particles:
        """Particles spread evenly over the free space."""
        rng = np.random.default_rng([self.seed, 0])
        m = self.config.particles
        return Particles(self._anywhere(m, rng), np.full(m, 1 / m))

    def advance(self, state: Particles, part: RobotLog) -> tuple[Particles, LocalizationStep]:
        """One time step: every spread scan moves, weighs and redraws the particles."""
        rng = np.random.default_rng([self.seed, state.steps + 1])
        first = state.steps == 0
        segment = segment_of(part, self.config.segment, first)
        poses, weights = state.poses, state.weights
        slow, fast = state.slow, state.fast
        last = part.odometry[0]
        for i in _scan_order(part, self.config.segment, first):
            poses = self._moved(poses, between(last, part.odometry[i]), rng)
            last = part.odometry[i]
            scan = segment_of(part.slice(i, i + 1), self.config.segment, True)
            weights, fit = self._weighed(poses, weights, scan)
            slow += self.config.slow * (fit - slow) if slow > 0 else fit
            fast += self.config.fast * (fit - fast) if fast > 0 else fit
            if 1 / (weights**2).sum() < self.config.resample_below * len(weights):
                poses, weights = self._redrawn(poses, weights, max(0.0, 1 - fast / slow), rng)
        poses = self._moved(poses, between(last, part.odometry[-1]), rng)
        state = Particles(poses, weights, slow, fast, state.steps + 1)
        return state, self._step(state, segment, float(part.t[-1]))

    def _anywhere(self, count: int, rng: np.random.Generator) -> FloatArray:
        cells = self.free[rng.integers(len(self.free), size=count)] + rng.uniform(
            -0.5, 0.5, (count, 2)
        )
        return np.column_stack((self.geometry.world_of(cells), rng.uniform(-np.pi, np.pi, count)))

    def _moved(self, poses: FloatArray, motion: FloatArray, rng: np.random.Generator) -> FloatArray:
        distance = float(np.hypot(motion[0], motion[1]))
        c, turn = self.config.motion, abs(float(motion[2]))
        if distance == 0 and turn == 0:
            return poses
        spread = math.hypot(c.distance_share * distance, c.per_root_metre * distance**0.5)
        spread_turn = math.hypot(c.turn_share * turn, c.turn_per_root_metre * distance**0.5)
        noise = rng.normal(size=poses.shape) * (spread, spread, spread_turn)
        return compose(poses, motion + noise)

    def _weighed(
        self, poses: FloatArray, weights: FloatArray, scan: Segment
    ) -> tuple[FloatArray, float]:
        points = scan.echo_points()
        total = np.zeros(len(poses))
        cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
        for x, y in points:
            at = np.stack((poses[:, 0] + cos * x - sin * y, poses[:, 1] + sin * x + cos * y), -1)
            total += self._looked_up(at)
        standing = self.geometry.cell_of(poses[:, :2])
        inside = self.geometry.contains(standing)
        free = np.zeros(len(poses), bool)
        free[inside] = self.is_free[tuple(standing[inside].T)]
        total += np.where(free, 0.0, self.log_outside * max(len(points), 1))
        fit = float((weights * np.exp(total / max(len(points), 1))).sum())
        weights = weights * np.exp(self.config.temper * (total - total.max()))
        return weights / weights.sum(), fit

    def _looked_up(self, points: FloatArray) -> FloatArray:
        cells = self.geometry.cell_of(points)
        inside = self.geometry.contains(cells)
        out = np.full(len(points), self.log_outside)
        out[inside] = self.log_field[tuple(cells[inside].T)]
        return out

    def _redrawn(
        self, poses: FloatArray, weights: FloatArray, lost: float, rng: np.random.Generator
    ) -> tuple[FloatArray, FloatArray]:
        m = len(poses)
        ticks = (rng.uniform() + np.arange(m)) / m
        chosen = np.minimum(np.searchsorted(np.cumsum(weights), ticks), m - 1)
        poses = poses[chosen].copy()
        new = rng.uniform(size=m) < lost
        poses[new] = self._anywhere(int(new.sum()), rng)
        return poses, np.full(m, 1 / m)

    def _step(self, state: Particles, segment: Segment, t: float) -> LocalizationStep:
        places = self.places
        cells = places.grid.geometry.cell_of(state.poses[:, :2])
        cells = np.clip(cells, 0, np.array(places.grid.geometry.shape) - 1)
        node = places.node_of[cells[:, 0], cells[:, 1]]
        mass = np.bincount(node, state.weights, minlength=len(places.nodes))
        p = np.asarray(mass / mass.sum(), float)
        poses = np.full((len(places.nodes), 3), np.nan)
        for i in np.unique(node):
            inside = node == i
            poses[i] = _mean_pose(state.poses[inside], state.weights[inside])
        best = int(p.argmax())
        return LocalizationStep(
            state.steps,
            t,
            dict(zip(places.nodes, p.tolist(), strict=True)),
            0.0,
            places.nodes[best],
            poses[best],
            entropy_of(p),
            len(segment) > 0,
            {places.nodes[i]: Candidate(poses[i], float(p[i])) for i in np.unique(node)},
            segment.echo_points(),
            explain(places.names, p, 0.0, p, segment.distance, poses),
        )


def _scan_order(part: RobotLog, config: SegmentConfig, first: bool) -> list[int]:
    """Scans spread along the drive, in the order of time."""
    taken: list[int] = []
    for i in range(0 if first else 1, len(part)):
        if taken:
            dx, dy, turn = part.odometry[i] - part.odometry[taken[-1]]
            if np.hypot(dx, dy) < config.gap and abs(float(wrap_angle(turn))) < config.gap_angle:
                continue
        taken.append(i)
    return taken


def _mean_pose(poses: FloatArray, weights: FloatArray) -> FloatArray:
    """The mean of the particles near the heaviest place of a node."""
    heaviest = poses[int(weights.argmax())]
    near = np.hypot(*(poses[:, :2] - heaviest[:2]).T) < 0.5
    w = weights[near] / weights[near].sum()
    x, y = (poses[near, :2] * w[:, None]).sum(axis=0)
    heading = math.atan2((np.sin(poses[near, 2]) * w).sum(), (np.cos(poses[near, 2]) * w).sum())
    return np.array([x, y, heading])
