"""Drift correction of a drive that has not ended: state + scan -> state.

The same submaps, closures and pose graph as in `drift_correction`, node by node as the robot reaches
them. A node's local map is whole only some metres later; until then the newest one counts with what was
seen on the way to it, by provisional closures that the next node replaces. Visits are not aligned with
each other as the batch does at its end: a drive that has ended is best corrected again as a whole.

    poses = GrowingTrajectory(ring)
    for scan in scans:
        pose = poses.add(scan)
        if poses.moved > cell:
            everything = poses.told()   # map the drive again at these
"""

from __future__ import annotations

import math

import numpy as np

from core.geometry import FloatArray, between, compose, wrap_angle
from core.mapping.drift_config import DriftConfig
from core.mapping.loop_closure import Closure, close_loops
from core.mapping.node_view import local_map
from core.mapping.odometry_calibration import OdometryCalibration
from core.mapping.odometry_model import through_nodes, without_systematic_error
from core.mapping.pose_graph import PoseGraph
from core.mapping.reflection_points import ReflectionPoints, reflection_points
from core.mapping.submap import Submap
from core.sensing import RobotLog, Scan, SonarRing

JUMP_STEP, JUMP_SPEED = 0.25, 2.0
"""Metres, and metres a second: a step beyond both is a jump of the odometry (as in `odometry_breaks`)."""


class GrowingTrajectory:
    """The corrected trajectory of the drive so far. Can be pickled between two scans.

    Attributes:
        closures: places found again so far, accepted or not.
        moved: the farthest (m) that the pose of a scan lies from where `add` put it, or `told`
            later.
    """

    def __init__(self, ring: SonarRing, config: DriftConfig | None = None) -> None:
        self.closures: list[Closure] = []
        self.moved = 0.0
        self._config = config or DriftConfig()
        self._ring = ring
        self._scans: list[Scan] = []
        self._odometry: list[FloatArray] = []
        self._length: list[float] = []
        self._poses: list[FloatArray] = []
        self._told: list[FloatArray] = []
        self._graph: PoseGraph | None = None
        self._submaps: dict[int, Submap] = {}
        self._links = 0

    def __len__(self) -> int:
        return len(self._scans)

    def add(self, scan: Scan) -> FloatArray:
        """Takes in a scan; its pose (3,) as far as it is known now."""
        self._scans.append(scan)
        if len(self._scans) == 1:
            self._odometry, self._poses, self._length = [scan.odometry], [scan.odometry], [0.0]
            self._told = [scan.odometry]
            return scan.odometry
        step = self._step(scan)
        self._odometry.append(compose(self._odometry[-1], step))
        turn = self._config.reflection.metres_per_radian * abs(float(wrap_angle(step[2])))
        self._length.append(self._length[-1] + float(np.hypot(step[0], step[1])) + turn)
        self._poses.append(compose(self._poses[-1], self._calibrated(step)))
        last_node = 0 if self._graph is None else int(self._graph.nodes[-1])
        if self._length[-1] - self._length[last_node] >= self._config.spacing:
            self._reach_node()
        self._told.append(self._poses[-1])
        return self._poses[-1]

    def told(self) -> FloatArray:
        """(N, 3) poses of all scans so far, anchored at the first one's odometry; `moved` starts anew."""
        self.moved = 0.0
        self._told = self._poses.copy()
        return np.array(self._poses).reshape(-1, 3)

    @property
    def calibration(self) -> OdometryCalibration | None:
        """The systematic errors so far; None before the first node."""
        if self._graph is None:
            return None
        return OdometryCalibration.of(self._graph.error, self._graph.error_sigma())

    def _step(self, scan: Scan) -> FloatArray:
        """The odometry's motion (3,) to the newest scan; at a jump it goes on as before."""
        before = self._scans[-2]
        step = between(before.odometry, scan.odometry)
        limit = max(JUMP_STEP, JUMP_SPEED * (scan.t - before.t))
        if float(np.hypot(step[0], step[1])) <= limit:
            return step
        if len(self._odometry) < 2:
            return np.zeros(3)
        return between(self._odometry[-2], self._odometry[-1])

    def _calibrated(self, step: FloatArray) -> FloatArray:
        """A motion without the systematic errors found so far."""
        if self._graph is None:
            return step
        ends = np.stack((np.zeros(3), step))
        return np.asarray(without_systematic_error(ends, self._graph.error)[1])

    def _reach_node(self) -> None:
        """The newest scan becomes a node; what its stretch tells moves the whole drive."""
        odometry, length = np.array(self._odometry), np.array(self._length)
        graph = self._longer_graph(odometry)
        newest = len(graph.nodes) - 1
        del graph.links[self._links :]
        graph.solve(2)
        points = self._recent_points(length, odometry)
        local = without_systematic_error(odometry, graph.error)
        whole = newest - math.ceil(self._config.half_span + 0.5)
        if whole >= 0:
            self._submaps[whole] = self._view(graph, points, local, length, whole)
            self.closures += self._close(graph, self._submaps, whole)
            self._links = len(graph.links)
        view = self._view(graph, points, local, length, newest)
        self._close(graph, self._submaps | {newest: view}, newest)
        graph.solve(3)
        self._move(odometry, length, graph)

    def _longer_graph(self, odometry: FloatArray) -> PoseGraph:
        """The graph with the newest scan as its last node."""
        newest = len(odometry) - 1
        if self._graph is None:
            nodes = np.array([0, newest], np.int64)
            self._graph = PoseGraph(odometry, nodes, self._config.noise, self._config.graph)
        else:
            self._graph.lengthen(odometry, np.append(self._graph.nodes, newest))
        self._graph.extend()
        return self._graph

    def _recent_points(self, length: FloatArray, odometry: FloatArray) -> ReflectionPoints:
        """The reflecting points of all that the views of the last nodes need."""
        config = self._config
        back = (2 * config.half_span + 2) * config.spacing + config.wall_span
        first = int(np.searchsorted(length, length[-1] - back))
        recent = self._scans[first:]
        log = RobotLog(
            "recent",
            self._ring,
            np.array([scan.t for scan in recent]),
            odometry[first:],
            np.array([scan.ranges for scan in recent]),
            np.array([scan.fresh for scan in recent]),
        )
        points = reflection_points(log, log.odometry, config.reflection)
        return ReflectionPoints(points.scan + first, points.sonar, points.point, points.strong)

    def _view(
        self,
        graph: PoseGraph,
        points: ReflectionPoints,
        local: FloatArray,
        length: FloatArray,
        node: int,
    ) -> Submap:
        """What is seen from a node as far as it is known; replaces the walls seen there before."""
        graph.walls.pop(node, None)
        return local_map(graph, points, local, length, node, self._config)

    def _close(self, graph: PoseGraph, submaps: dict[int, Submap], node: int) -> list[Closure]:
        """Tries a node's view against the whole ones before it."""
        others = [other for other in submaps if node - other >= self._config.apart]
        t = np.array([scan.t for scan in self._scans])
        return close_loops(
            graph, submaps, node, others, t, self._config.closure, self._config.matching
        )

    def _move(self, odometry: FloatArray, length: FloatArray, graph: PoseGraph) -> None:
        """Carries all scans along with their nodes."""
        poses = through_nodes(odometry, length, graph.nodes, graph.poses)
        self._poses = list(poses)
        told = np.array(self._told)
        off = np.hypot(*(poses[: len(told), :2] - told[:, :2]).T)
        self.moved = float(off.max())
