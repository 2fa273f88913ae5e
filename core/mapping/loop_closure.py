"""Finding places again: which local maps may show the same place, and whether they do.

A pair is tried when the pose graph says that the two may overlap, within what it says about the
uncertainty of their relative pose. It is rejected when too few points agree, when another pose is nearly
as good (a corridor, a mirrored room), or when the best pose lies at the border of the search.
"""

from __future__ import annotations

import math
from collections.abc import Container
from dataclasses import dataclass, replace

import numpy as np

from core.geometry import FloatArray, between
from core.mapping.graph_terms import Link
from core.mapping.matching_config import MatchingConfig
from core.mapping.pose_graph import PoseGraph
from core.mapping.scan_matching import Match, match
from core.mapping.submap import Submap


@dataclass(frozen=True)
class ClosureConfig:
    """Parameters; chosen on simulated homes, where about 99 % of the accepted closures are right.

    Attributes:
        min_score: least mean agreement per point.
        max_ambiguity: highest share of the best score that another pose may reach.
        near: submaps whose middles are nearer than this (m) overlap.
        most: at most this many pairs are tried for a submap, the nearest ones.
        sigmas: the search covers this many standard deviations of the predicted pose ...
        reach_floor, turn_floor: ... and this much more (m, rad) ...
        reach_limit, turn_limit: ... but not more than this.
    """

    min_score: float = 0.12
    max_ambiguity: float = 0.95
    near: float = 2.5
    most: int = 8
    sigmas: float = 2.5
    reach_floor: float = 0.2
    turn_floor: float = 0.06
    reach_limit: float = 1.5
    turn_limit: float = 0.4


@dataclass(frozen=True)
class Closure:
    """Two moments at which the robot was at one place, or was thought to be.

    Attributes:
        t_source, t_target: seconds.
        scan_source, scan_target: the same as indices of scans.
        pose: (3,) of the robot at the target in its frame at the source.
        score, ambiguity: of the match.
        accepted: it was used.
        reason: why or why not, in words.
        by_person: a person said so.
    """

    t_source: float
    t_target: float
    scan_source: int
    scan_target: int
    pose: FloatArray
    score: float
    ambiguity: float
    accepted: bool
    reason: str
    by_person: bool = False

    @property
    def id(self) -> str:
        """Names the closure: the milliseconds of its ends. The same in every correction of the drive."""
        return closure_id(self.t_source, self.t_target)


def closure_id(t_source: float, t_target: float) -> str:
    """The id of a closure between two times (s)."""
    return f"c{round(1000 * t_source)}_{round(1000 * t_target)}"


def close_loops(
    graph: PoseGraph,
    submaps: dict[int, Submap],
    node: int,
    others: list[int],
    t: FloatArray,
    config: ClosureConfig,
    matching: MatchingConfig,
    rejected: Container[str] = (),
) -> list[Closure]:
    """Tries a node's submap against earlier ones; accepted closures become links of the graph.

    Args:
        graph: solved, with the node in it.
        submaps: by node.
        node: the new one.
        others: earlier nodes that share nothing with it.
        t: (N,) times of the scans.
        config, matching: parameters.
        rejected: ids of closures that a person called wrong.
    """
    found: list[Closure] = []
    for other, covariance in _overlapping(graph, node, others, config):
        reach = config.sigmas * math.sqrt(max(covariance[0, 0], covariance[1, 1]))
        turn = config.sigmas * math.sqrt(covariance[2, 2])
        result = match(
            submaps[node],
            submaps[other],
            between(graph.poses[other], graph.poses[node]),
            min(config.reach_limit, reach + config.reach_floor),
            min(config.turn_limit, turn + config.turn_floor),
            matching,
        )
        if result is None:
            continue
        reason = _objection(result, config)
        source, target = int(graph.nodes[other]), int(graph.nodes[node])
        closure = Closure(
            float(t[source]), float(t[target]), source, target, result.pose, result.score,
            result.ambiguity, reason is None, reason or "the local maps agree",
        )  # fmt: skip
        if closure.id in rejected:
            said = "rejected by a person"
            closure = replace(closure, accepted=False, reason=said, by_person=True)
        if closure.accepted:
            information = np.asarray(np.linalg.inv(result.covariance), float)
            graph.links.append(Link(other, node, result.pose, information))
        found.append(closure)
    return found


def _overlapping(
    graph: PoseGraph, node: int, others: list[int], config: ClosureConfig
) -> list[tuple[int, FloatArray]]:
    """The nearest of the nodes that may overlap, with the covariance of their relative pose."""
    if not others:
        return []
    distance = np.hypot(*(graph.poses[others, :2] - graph.poses[node, :2]).T)
    order = np.argsort(distance, kind="stable")
    nearest = [k for k in order if distance[k] < config.near + config.reach_limit]
    nearest = nearest[: 2 * config.most]
    if not nearest:
        return []
    covariances = graph.relative_covariance([(others[k], node) for k in nearest])
    out = []
    for k, covariance in zip(nearest, covariances, strict=True):
        sigma = math.sqrt(max(covariance[0, 0], covariance[1, 1]))
        if distance[k] <= config.near + min(config.reach_limit, sigma):
            out.append((others[k], covariance))
    return out[: config.most]


def _objection(result: Match, config: ClosureConfig) -> str | None:
    """Why a match is not believed, or None."""
    if result.score < config.min_score:
        return f"too few points agree (score {result.score:.2f} of at least {config.min_score:.2f})"
    if result.ambiguity > config.max_ambiguity:
        return f"another pose is nearly as good ({result.ambiguity:.0%})"
    if result.at_edge:
        return "the best pose lies at the border of the search"
    return None
