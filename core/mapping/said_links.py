"""How what a person says about the drift enters the pose graph.

Closures that were said or confirmed by a person are refined by scan matching where it finds something,
and keep their full weight however much the rest disagrees.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from core.errors import InputError
from core.geometry import FloatArray, IntArray, between, compose, inverse
from core.mapping.drift_edits import CLOSURE_ID, Dragged, DriftEdits
from core.mapping.graph_terms import Link
from core.mapping.loop_closure import Closure, closure_id
from core.mapping.matching_config import MatchingConfig
from core.mapping.pose_graph import PoseGraph
from core.mapping.scan_matching import match
from core.mapping.submap import Submap

CLOCK = 0.5
"""Seconds that a time may lie outside of a drive: it was rounded, or pointed at from afar."""
OPEN_HEADING = 1e-4
"""Information (1/rad^2) about a heading that nobody gave; not zero, to keep the system regular."""


@dataclass(frozen=True)
class EditConfig:
    """How exactly a person means it.

    Attributes:
        same_place, same_heading: standard deviations (m, rad) of two places called the same where
            scan matching finds nothing.
        dragged_place, dragged_heading: standard deviations (m, rad) of a place that was dragged to:
            smaller than a person means it, to win against the hundreds of surfaces seen from there.
        reach, turn_reach: how far around what was said (m, rad) scan matching searches.
        min_score: a match below it is not a finding.
    """

    same_place: float = 0.4
    same_heading: float = math.radians(8)
    dragged_place: float = 0.02
    dragged_heading: float = math.radians(1)
    reach: float = 1.2
    turn_reach: float = 0.5
    min_score: float = 0.08


@dataclass(frozen=True)
class _Saying:
    """Two nodes said to be at one place; offsets (3,) from the nodes to where a person pointed."""

    source: int
    target: int
    from_source: FloatArray
    from_target: FloatArray
    same_place: bool


class SaidLinks:
    """The edits of a drive, brought to the nodes of its graph."""

    def __init__(
        self,
        edits: DriftEdits,
        t: FloatArray,
        nodes: IntArray,
        odometry: FloatArray,
        config: EditConfig | None = None,
    ) -> None:
        """
        Args:
            edits: what was said.
            t: (N,) seconds of the scans.
            nodes: (K,) scans of the nodes.
            odometry: (N, 3), right over a few metres.
            config: parameters.

        Raises:
            InputError: something was said about another time than that of the drive, about one place
                twice, or about the start, which fixes the map's frame.
        """
        self._config = config or EditConfig()
        self._t, self._nodes, self._odometry = t, nodes, odometry
        pairs = [(*_times(said), False) for said in edits.accepted]
        pairs += [(same.t_source, same.t_target, True) for same in edits.same_places]
        sayings = [self._saying(min(a, b), max(a, b), same) for a, b, same in pairs]
        self._sayings = [said for said in sayings if self._id(said) not in edits.rejected]
        self._dragged = [(self._node_at(dragged.t), dragged) for dragged in edits.dragged]
        if any(node == 0 for node, _ in self._dragged):
            raise InputError("the start of the drive fixes the map's frame and cannot be dragged")

    def others(self, node: int) -> set[int]:
        """The earlier nodes about which something was said together with this one."""
        return {saying.source for saying in self._sayings if saying.target == node}

    def link(
        self, graph: PoseGraph, submaps: Mapping[int, Submap], node: int, matching: MatchingConfig
    ) -> list[Closure]:
        """Adds to the graph what was said about the node just reached; the closures among it."""
        for at, dragged in self._dragged:
            if at == node:
                graph.links.append(self._drag(graph, node, dragged))
        return [
            self._close(graph, submaps, saying, matching)
            for saying in self._sayings
            if saying.target == node
        ]

    def _saying(self, t_source: float, t_target: float, same_place: bool) -> _Saying:
        source, target = self._node_at(t_source), self._node_at(t_target)
        if source == target:
            raise InputError(
                f"{t_source:.1f} s and {t_target:.1f} s are the same place of the drive already"
            )
        ends = self._offset(source, t_source), self._offset(target, t_target)
        return _Saying(source, target, *ends, same_place)

    def _id(self, saying: _Saying) -> str:
        """The id of the closure that the saying makes."""
        source, target = self._t[self._nodes[[saying.source, saying.target]]]
        return closure_id(float(source), float(target))

    def _node_at(self, t: float) -> int:
        """The node nearest to a time."""
        if not self._t[0] - CLOCK <= t <= self._t[-1] + CLOCK:
            raise InputError(
                f"{t:.1f} s lies outside of the drive ({self._t[0]:.1f} s to {self._t[-1]:.1f} s)"
            )
        return int(np.abs(self._t[self._nodes] - t).argmin())

    def _offset(self, node: int, t: float) -> FloatArray:
        """Where (3,) the robot was at a time, seen from a node nearby."""
        scan = int(np.abs(self._t - t).argmin())
        return between(self._odometry[self._nodes[node]], self._odometry[scan])

    def _close(
        self,
        graph: PoseGraph,
        submaps: Mapping[int, Submap],
        saying: _Saying,
        matching: MatchingConfig,
    ) -> Closure:
        """The closure of two nodes: where scan matching finds them, else where the person says."""
        config, source, target = self._config, saying.source, saying.target
        guess = between(graph.poses[source], graph.poses[target])
        reason = "accepted by a person"
        if saying.same_place:
            guess, reason = _coinciding(saying, guess), "called the same place by a person"
        found = match(
            submaps[target], submaps[source], guess, config.reach, config.turn_reach, matching
        )
        sigma = np.array([config.same_place, config.same_place, config.same_heading])
        pose, covariance = guess, np.diag(sigma**2)
        if found is not None and found.score >= config.min_score and not found.at_edge:
            pose, covariance = found.pose, found.covariance
        else:
            reason += "; the local maps do not show it"
        information = np.asarray(np.linalg.inv(covariance), float)
        graph.links.append(Link(source, target, pose, information, by_person=True))
        scans = int(self._nodes[source]), int(self._nodes[target])
        score, ambiguity = (found.score, found.ambiguity) if found else (0.0, 1.0)
        times = float(self._t[scans[0]]), float(self._t[scans[1]])
        return Closure(*times, *scans, pose, score, ambiguity, True, reason, by_person=True)

    def _drag(self, graph: PoseGraph, node: int, dragged: Dragged) -> Link:
        """Holds a node where a person put it, as seen from the first pose, which never moves."""
        config, offset = self._config, self._offset(node, dragged.t)
        heading, sure = dragged.heading, 1 / config.dragged_heading**2
        if heading is None:
            heading, sure = graph.poses[node, 2] + offset[2], OPEN_HEADING
        place = compose(np.array([dragged.x, dragged.y, heading]), inverse(offset))
        information = np.diag([config.dragged_place**-2, config.dragged_place**-2, sure])
        return Link(0, node, between(graph.poses[0], place), information, by_person=True)


def _coinciding(saying: _Saying, predicted: FloatArray) -> FloatArray:
    """Relative pose of the nodes if the two places coincide; the turn between them is the graph's."""
    turn = predicted[2] + saying.from_target[2] - saying.from_source[2]
    at_target = compose(saying.from_source, np.array([0.0, 0.0, turn]))
    return compose(at_target, inverse(saying.from_target))


def _times(closure_id: str) -> tuple[float, float]:
    """Seconds of the two ends of a closure."""
    if not CLOSURE_ID.fullmatch(closure_id):
        raise InputError(f"{closure_id!r} is no id of a closure")
    source, target = closure_id[1:].split("_")
    return int(source) / 1000, int(target) / 1000
