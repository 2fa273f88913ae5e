"""Where on its arc a sonar reading was reflected.

A reading says how far the nearest surface is, not where in the beam. Drawn on the beam's axis, the
points of a wall lie up to r (1 - cos 25 deg) in front of it; arcs of neighbouring poses, however, cross
where the surface is. Every arc votes for the cells it passes within a short stretch of travel, and each
reading takes the bearing whose cell most arcs of its neighbourhood agree on. This is triangulation
based fusion (Wijk and Christensen 2000) by voting. Only local odometry is used, so that drift does not
matter.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np

from core.geometry import BoolArray, FloatArray, IntArray, wrap_angle
from core.sensing.ring import SonarRing
from core.sensing.robot_log import RobotLog


@dataclass(frozen=True)
class ReflectionConfig:
    """Parameters of the vote.

    Attributes:
        max_range: readings beyond are not used (m): their arcs are too wide to cross sharply.
        window: travel (m) before and after a reading whose arcs vote about it.
        metres_per_radian: how much travel a turn on the spot counts for.
        min_step: a sonar's next reading is used after this much travel (m), so that a robot that
            stands does not outvote one that drives.
        cell: side of a voting cell (m).
        bearings: bearings tried over the full beam.
        edge_weight: how fast the belief in a bearing falls off to the edge of the beam:
            exp(-edge_weight (theta / half beam)^2).
        strong_share: points with at least this share of the median vote are called strong.
    """

    max_range: float = 3.5
    window: float = 1.5
    metres_per_radian: float = 0.3
    min_step: float = 0.02
    cell: float = 0.05
    bearings: int = 11
    edge_weight: float = 1.0
    strong_share: float = 0.7


@dataclass(frozen=True)
class ReflectionPoints:
    """The readings of a log as points.

    Attributes:
        scan: (M,) index of the scan, ascending.
        sonar: (M, 2) where the transducer sits, robot frame, metres.
        point: (M, 2) where the echo comes from, robot frame, metres.
        strong: (M,) the neighbouring arcs agree.
    """

    scan: IntArray
    sonar: FloatArray
    point: FloatArray
    strong: BoolArray

    def __len__(self) -> int:
        return len(self.scan)


def path_length(poses: FloatArray, metres_per_radian: float) -> FloatArray:
    """(N,) travel in metres at each of the poses (N, 3), turns counted in."""
    steps = np.hypot(np.diff(poses[:, 0]), np.diff(poses[:, 1]))
    turns = np.abs(wrap_angle(np.diff(poses[:, 2])))
    return np.concatenate(([0.0], np.cumsum(steps + metres_per_radian * turns)))


def reflection_points(
    log: RobotLog, poses: FloatArray, config: ReflectionConfig | None = None
) -> ReflectionPoints:
    """The reflecting points of all usable readings, in the robot's frame of their scan.

    Args:
        log: the drive.
        poses: (N, 3) poses that are right over a few metres; the odometry will do.
        config: parameters of the vote.
    """
    config = config or ReflectionConfig()
    length = path_length(poses, config.metres_per_radian)
    scan, channel = _usable(log, length, config)
    ring = _ring_table(log.ring)
    reading = np.ascontiguousarray(log.ranges[scan, channel])
    offset = np.zeros(len(scan))
    votes = np.zeros(len(scan))
    side = _torus_side(log.ring, config)
    _vote(
        np.ascontiguousarray(poses), scan, channel, reading, ring, length,
        config.window, config.cell, config.bearings, config.edge_weight, side, offset, votes,
    )  # fmt: skip
    bearing = ring[channel, 2] + offset
    sonar = ring[channel, :2]
    point = sonar + reading[:, None] * np.stack((np.cos(bearing), np.sin(bearing)), axis=1)
    threshold = config.strong_share * float(np.median(votes)) if len(votes) else 0.0
    return ReflectionPoints(scan, sonar, point, votes >= threshold)


def _usable(
    log: RobotLog, length: FloatArray, config: ReflectionConfig
) -> tuple[IntArray, IntArray]:
    """(scan, channel) of the readings that say something new about something near."""
    limit = np.array([min(config.max_range, sonar.max_range - 0.02) for sonar in log.ring.sonars])
    floor = np.array([sonar.min_range for sonar in log.ring.sonars])
    with np.errstate(invalid="ignore"):
        usable = log.fresh & (log.ranges < limit) & (log.ranges >= floor)
    step = np.floor(length / config.min_step).astype(np.int64)
    for channel in range(usable.shape[1]):
        scans = np.flatnonzero(usable[:, channel])
        repeated = np.flatnonzero(np.diff(step[scans]) == 0) + 1
        usable[scans[repeated], channel] = False
    scan, channel_of = np.nonzero(usable)
    return scan.astype(np.int64), channel_of.astype(np.int64)


def _ring_table(ring: SonarRing) -> FloatArray:
    """(S, 4): x, y, heading, beam width of the sonars."""
    return np.array([(s.x, s.y, s.heading, s.beam_width) for s in ring.sonars], float)


def _torus_side(ring: SonarRing, config: ReflectionConfig) -> int:
    """Cells along one side of the voting grid. It wraps around, because votes are local: wide enough
    that no two arcs of one window meet on the other side."""
    mount = max((math.hypot(s.x, s.y) for s in ring.sonars), default=0.0)
    return int(math.ceil(2 * (config.window + config.max_range + mount) / config.cell)) + 4


@numba.njit(cache=True)
def _vote(  # type: ignore[no-untyped-def]
    poses, scan, channel, reading, ring, length, window, cell, bearings, edge_weight, side, offset, votes
):  # fmt: skip
    """Fills `offset` (rad off the beam's axis) and `votes` of each reading; see the module's text."""
    grid = np.zeros((side, side), np.float32)
    count = len(scan)
    cells = np.empty((count, bearings, 2), np.int64)
    belief = np.empty(bearings, np.float32)
    for j in range(bearings):
        share = 2 * j / (bearings - 1) - 1
        belief[j] = math.exp(-edge_weight * share * share)
    for i in range(count):
        x, y, heading = poses[scan[i]]
        c, s = math.cos(heading), math.sin(heading)
        mount = ring[channel[i]]
        sx, sy = x + c * mount[0] - s * mount[1], y + s * mount[0] + c * mount[1]
        for j in range(bearings):
            theta = heading + mount[2] + (j / (bearings - 1) - 0.5) * mount[3]
            cells[i, j, 0] = int(math.floor((sx + reading[i] * math.cos(theta)) / cell)) % side
            cells[i, j, 1] = int(math.floor((sy + reading[i] * math.sin(theta)) / cell)) % side
    first, last = 0, 0
    for i in range(count):
        here = length[scan[i]]
        while last < count and length[scan[last]] <= here + window:
            _add_arc(grid, cells[last], belief, 1.0)
            last += 1
        while first < count and length[scan[first]] < here - window:
            _add_arc(grid, cells[first], belief, -1.0)
            first += 1
        best, best_j = -1.0, bearings // 2
        for j in range(bearings):
            u, v = cells[i, j]
            around = (
                grid[(u + 1) % side, v] + grid[u - 1, v] + grid[u, (v + 1) % side] + grid[u, v - 1]
            )
            vote = (2 * grid[u, v] + around) * belief[j]
            if vote > best + 1e-6:
                best, best_j = vote, j
        offset[i] = (best_j / (bearings - 1) - 0.5) * ring[channel[i], 3]
        votes[i] = best


@numba.njit(cache=True)
def _add_arc(grid, arc, belief, sign):  # type: ignore[no-untyped-def]
    """Adds (or takes away) one arc; a cell that several bearings hit counts once."""
    u, v = -1, -1
    for j in range(len(arc)):
        if arc[j, 0] != u or arc[j, 1] != v:
            grid[arc[j, 0], arc[j, 1]] += sign * belief[j]
        u, v = arc[j, 0], arc[j, 1]
