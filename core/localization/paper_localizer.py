"""The paper's localization as written (Sect. 4, Fig. 6): one candidate per node, eq. (10)-(21).

Where the paper is silent, the choice is named where it is made: the template's centre (template.py),
theta_c (distance_vector.py), rays without an obstacle (`no_obstacle` below), negative correlations
(matching.py), the threshold of the entropy test (entropy_test.py). The belief is about the centre of
the template, as in the paper; poses are told for the robot at the end of the step, placed by theta_c.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from core.geometry import FloatArray, IntArray, between, compose, wrap_angle
from core.localization.distance_vector import dissimilarity, distance_vector
from core.localization.entropy_test import EntropyTestConfig, entropy_of, is_accepted
from core.localization.explanation import explain
from core.localization.localization_step import Candidate, LocalizationStep
from core.localization.matching import distance_similarity, matching_probability
from core.localization.motion_model import (
    EffectiveMotionConfig,
    angle_transition,
    came_from,
    distance_transition,
)
from core.localization.node_probability import posterior, prior
from core.localization.ring_projection import correlation, ring_vector, ring_vectors
from core.localization.template import Template, template_of
from core.mapping.cemal import CemalConfig, cemal_map
from core.sensing import RobotLog, Trajectory
from core.sensing.robot_log import join
from core.topology import Model


@dataclass(frozen=True)
class PaperConfig:
    """Parameters of the paper's method.

    Attributes:
        largest_radius: metres up to which rings are made (the paper: half the template).
        no_obstacle: metres taken for a direction without an obstacle in eq. (12).
        motion: sigma_d and sigma_a.
        entropy: when the entropy test is applied.
    """

    largest_radius: float = 4.0
    no_obstacle: float = 6.0
    motion: EffectiveMotionConfig = field(default_factory=EffectiveMotionConfig)
    entropy: EntropyTestConfig = field(default_factory=EntropyTestConfig)


@dataclass(frozen=True)
class Matched:
    """A belief and what it was made from.

    Attributes:
        probabilities: (n,) of the nodes.
        places: (n, 2) candidates L_t, world metres.
        centre: (2,) centre of the template in the odometry frame.
        transition: (n, n) P(N_t = i | N_t-1 = j) without the angle; None at the first step.
    """

    probabilities: FloatArray
    places: FloatArray
    centre: FloatArray
    transition: FloatArray | None


@dataclass(frozen=True)
class PaperState:
    """Between two time steps: the last two beliefs, and the local map that still grows, if any."""

    last: tuple[Matched, ...] = ()
    growing: RobotLog | None = None
    steps: int = 0
    poses: FloatArray | None = None
    fits: FloatArray | None = None


class PaperLocalizer:
    """The paper's method for one model."""

    def __init__(self, model: Model, config: PaperConfig | None = None) -> None:
        self.config = config or PaperConfig()
        self.grid = model.grid
        nodes = model.topology.nodes
        self.nodes = tuple(node.id for node in nodes)
        self.names = tuple(node.label or node.id for node in nodes)
        self.cells = tuple(
            np.argwhere((model.regions == node.region) & model.grid.free) for node in nodes
        )
        self.positions = np.array([node.position for node in nodes], float).reshape(-1, 2)
        every = np.concatenate([*self.cells, np.zeros((0, 2), np.int64)])
        self._radius = round(self.config.largest_radius / model.grid.geometry.resolution)
        rings = ring_vectors(model.grid.occupied, every, self._radius)
        self.rings = np.split(rings, np.cumsum([len(c) for c in self.cells])[:-1])

    def start(self) -> PaperState:
        """Nothing known."""
        return PaperState()

    def advance(self, state: PaperState, part: RobotLog) -> tuple[PaperState, LocalizationStep]:
        """One time step; a rejected one leaves the belief and lets the local map grow."""
        scans = part if state.growing is None else join(state.growing, part.slice(1, len(part)))
        end = scans.odometry[-1]
        matched, poses, fits = self._match(state, scans)
        last = state.last[-1].probabilities if state.last else None
        accepted = matched is not None and (
            last is None or is_accepted(last, matched.probabilities, self.config.entropy)
        )
        if accepted and matched is not None:
            state = PaperState((*state.last[-1:], matched), None, state.steps + 1, poses, fits)
        else:
            moved = between(part.odometry[0], end)
            poses = compose(state.poses, moved) if state.poses is not None else poses
            fits = state.fits if state.fits is not None else fits
            state = PaperState(state.last, scans, state.steps + 1, poses, fits)
        return state, self._step(state, scans, part, accepted)

    def _match(
        self, state: PaperState, scans: RobotLog
    ) -> tuple[Matched | None, FloatArray, FloatArray]:
        """The belief that the local map of some scans would give, poses and fits per node."""
        config = CemalConfig(resolution=self.grid.geometry.resolution)
        local = cemal_map(scans, Trajectory.from_odometry(scans), config)
        template = template_of(local)
        nowhere = np.column_stack((self.positions, np.zeros(len(self.nodes))))
        if template is None:
            return None, nowhere, np.zeros(len(self.nodes))
        cells, correlations = self._candidates(template)
        differences, turns = self._compare(template, cells)
        match = matching_probability(distance_similarity(differences), correlations)
        places = self.grid.geometry.world_of(cells)
        before = self._prior(state.last, places, template.centre)
        transition = None
        if state.last:
            transition = self._distance_transition(state.last[-1], places, template.centre)
        matched = Matched(posterior(match, before), places, template.centre, transition)
        return matched, _robot_poses(places, turns, template, scans.odometry[-1]), correlations

    def _candidates(self, template: Template) -> tuple[IntArray, FloatArray]:
        """The most similar location within each node (4.2.1): (n, 2) cells, (n,) rho."""
        radius = min(template.radius, self._radius)
        rows, cols = template.occupied.shape
        own = ring_vector(template.occupied, ((rows - 1) // 2, (cols - 1) // 2), radius)
        cells, best = [], []
        for i, inside in enumerate(self.cells):
            if len(inside) == 0:
                cells.append(self.grid.geometry.cell_of(self.positions[i]))
                best.append(0.0)
                continue
            rho = correlation(own, self.rings[i][:, : radius + 1])  # eq. (11)
            cells.append(inside[int(rho.argmax())])
            best.append(float(rho.max()))
        return np.array(cells, np.int64), np.array(best)

    def _compare(self, template: Template, cells: IntArray) -> tuple[FloatArray, FloatArray]:
        """Delta D_i (n,) and theta_c (n,) in radians of eq. (13)."""
        cap = self.config.no_obstacle / self.grid.geometry.resolution
        rows, cols = template.occupied.shape
        own = distance_vector(template.occupied, (rows - 1) / 2, (cols - 1) / 2, cap)
        found = [
            dissimilarity(own, distance_vector(self.grid.occupied, float(r), float(c), cap))
            for r, c in cells
        ]
        return np.array([d for d, _ in found]), np.radians([turn for _, turn in found])

    def _distance_transition(
        self, before: Matched, places: FloatArray, centre: FloatArray
    ) -> FloatArray:
        driven = float(np.hypot(*(centre - before.centre)))
        return distance_transition(before.places, places, driven, self.config.motion)

    def _prior(
        self, last: tuple[Matched, ...], places: FloatArray, centre: FloatArray
    ) -> FloatArray:
        """Eq. (17) with the motion model of eq. (18)-(20), as far back as there are steps."""
        if not last:
            return np.full(len(self.nodes), 1 / len(self.nodes))
        before = last[-1]
        transition = self._distance_transition(before, places, centre)
        if len(last) == 2 and before.transition is not None:
            way, onward = before.centre - last[0].centre, centre - before.centre
            turned = math.atan2(onward[1], onward[0]) - math.atan2(way[1], way[0])
            transition = transition * angle_transition(
                last[0].places,
                before.places,
                places,
                float(wrap_angle(turned)),
                came_from(before.transition, last[0].probabilities),
                self.config.motion,
            )  # eq. (19)
        return prior(transition, before.probabilities)

    def _step(
        self, state: PaperState, scans: RobotLog, part: RobotLog, accepted: bool
    ) -> LocalizationStep:
        n = len(self.nodes)
        p = state.last[-1].probabilities if state.last else np.full(n, 1 / n)
        poses = state.poses if state.poses is not None else np.zeros((n, 3))
        fits = state.fits if state.fits is not None else np.zeros(n)
        best = int(p.argmax())
        distance = float(np.hypot(*np.diff(part.odometry[:, :2], axis=0).T).sum())
        why = explain(self.names, p, 0.0, fits, distance, poses)
        return LocalizationStep(
            state.steps,
            float(part.t[-1]),
            dict(zip(self.nodes, p.tolist(), strict=True)),
            0.0,
            self.nodes[best],
            poses[best],
            entropy_of(p),
            accepted,
            {node: Candidate(poses[i], float(fits[i])) for i, node in enumerate(self.nodes)},
            self._template_points(scans),
            why if accepted else f"{why}; not updated, the local map goes on growing",
        )

    def _template_points(self, scans: RobotLog) -> FloatArray:
        """The template in the robot's frame at the end of the step: (K, 2)."""
        config = CemalConfig(resolution=self.grid.geometry.resolution)
        template = template_of(cemal_map(scans, Trajectory.from_odometry(scans), config))
        if template is None:
            return np.zeros((0, 2))
        seen = np.column_stack((template.points, np.zeros(len(template.points))))
        return between(scans.odometry[-1], seen)[:, :2]


def _robot_poses(
    places: FloatArray, turns: FloatArray, template: Template, robot: FloatArray
) -> FloatArray:
    """Where the robot is if the template's centre is at each place, turned back by theta_c: (n, 3)."""
    frame = np.column_stack((places, -turns))
    offset = np.array([*(robot[:2] - template.centre), robot[2]])
    return compose(frame, offset)
