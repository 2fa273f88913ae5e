"""The default method: a filter over a grid of poses, told as nodes.

It keeps the concepts of the paper's Sect. 4 - a template per time step, a candidate per node, a
motion model, node probabilities, entropy - and replaces the weak link, the single candidate chosen
by ring projection, by *all* poses: every reading is compared with the range expected at each pose
(eq. 12 for a wide beam), the motion model moves whole poses instead of distances and angles, and
the probability of a node is the mass of the poses in it.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from core.geometry import FloatArray
from core.localization.carried_robot import CarriedConfig, chance_carried, mixed
from core.localization.entropy_test import entropy_of
from core.localization.evidence import EvidenceConfig, updated
from core.localization.expected_range import ExpectedRangeConfig
from core.localization.explanation import MOSTLY, explain
from core.localization.localization_step import Candidate, LocalizationStep
from core.localization.node_belief import NodeBeliefConfig, best_poses, node_probabilities
from core.localization.place_map import PlaceMap, place_map, sonar_tables
from core.localization.pose_grid import PoseBelief
from core.localization.pose_motion import PoseMotionConfig, predict
from core.localization.pose_observation import ObservationConfig, ScoreArray, score_poses
from core.localization.reading_fit import FitConfig, share_explained
from core.localization.segment import Segment, SegmentConfig, segment_of
from core.localization.sonar_likelihood import SonarLikelihoodConfig
from core.sensing import RobotLog, SonarRing
from core.topology import Model


@dataclass(frozen=True)
class PoseGridConfig:
    """Parameters of the default method, the same for all homes and robots.

    Attributes:
        headings: headings in a full turn (5 degrees).
        unknown_at_start: chance that the robot starts outside the map.
        unknown_fit: share of the best possible score of the readings that a place outside the map
            is credited with: any home has walls that some place of this one resembles.
        coarse_sigma: standard deviation of an echo in the coarse pass, metres.
    """

    headings: int = 72
    unknown_at_start: float = 0.05
    unknown_fit: float = 0.09
    coarse_sigma: float = 0.15
    ranges: ExpectedRangeConfig = field(default_factory=ExpectedRangeConfig)
    likelihood: SonarLikelihoodConfig = field(default_factory=SonarLikelihoodConfig)
    segment: SegmentConfig = field(default_factory=SegmentConfig)
    motion: PoseMotionConfig = field(default_factory=PoseMotionConfig)
    observation: ObservationConfig = field(default_factory=ObservationConfig)
    evidence: EvidenceConfig = field(default_factory=EvidenceConfig)
    carried: CarriedConfig = field(default_factory=CarriedConfig)
    nodes: NodeBeliefConfig = field(default_factory=NodeBeliefConfig)
    fit: FitConfig = field(default_factory=FitConfig)


@dataclass(frozen=True)
class PoseGridState:
    """What is known between two time steps."""

    belief: PoseBelief
    steps: int


class PoseGridLocalizer:
    """The default method for one model and one sonar ring."""

    def __init__(
        self,
        model: Model,
        ring: SonarRing,
        config: PoseGridConfig | None = None,
        places: PlaceMap | None = None,
    ) -> None:
        self.config = config or PoseGridConfig()
        self.places = places or place_map(model, self.config.ranges, self.config.headings)
        likelihood = self.config.likelihood
        broad = replace(likelihood, sigma=self.config.coarse_sigma)
        self.kinds, self.kind_of_sonar = sonar_tables(
            self.places, ring, self.config.ranges, likelihood, broad
        )

    def start(self) -> PoseGridState:
        """Nothing known: anywhere in the map, or outside it."""
        return PoseGridState(PoseBelief.anywhere(self.places.grid, self.config.unknown_at_start), 0)

    def advance(
        self, state: PoseGridState, part: RobotLog
    ) -> tuple[PoseGridState, LocalizationStep]:
        """One time step: the scans `part` since the last step (its last scan comes first)."""
        first = state.steps == 0
        segment = segment_of(part, self.config.segment, first)
        prior = state.belief if first else self.predicted(state.belief, segment)
        belief = self.corrected(prior, segment)
        state = PoseGridState(belief, state.steps + 1)
        return state, self._step(state, segment, float(part.t[-1]))

    def predicted(self, belief: PoseBelief, segment: Segment) -> PoseBelief:
        """The belief after the motion of a segment (eq. 17 over poses)."""
        dx, dy, turn = (float(v) for v in segment.odometry)
        return predict(
            belief, self.places.grid, (dx, dy, turn), segment.distance, segment.turned,
            self.config.motion,
        )  # fmt: skip

    def corrected(self, prior: PoseBelief, segment: Segment) -> PoseBelief:
        """The belief after the readings of a segment (eq. 16 over poses).

        A robot that was carried somewhere in the middle of the segment is looked for with the
        newest readings alone.
        """
        belief = self._updated(prior, segment)
        newest = segment.newest(self.config.carried.newest)
        if not self._may_be_carried(belief, newest):
            return belief
        anywhere = PoseBelief.anywhere(self.places.grid, self.config.unknown_at_start)
        scores = self.scores(mixed(belief, anywhere, 0.5), newest)
        chance = chance_carried(
            belief,
            anywhere,
            scores,
            self.config.evidence.temper,
            self.config.carried.suspicion,
        )
        return mixed(belief, self._updated(anywhere, newest), chance)

    def _updated(self, prior: PoseBelief, segment: Segment) -> PoseBelief:
        if len(segment) == 0:
            return prior
        possible = self.best_possible(segment)
        return updated(
            prior,
            self.scores(prior, segment),
            self.places.blocks,
            self.config.unknown_fit * possible,
            possible,
            self.config.evidence,
        )

    def _may_be_carried(self, belief: PoseBelief, newest: Segment) -> bool:
        """Whether the newest readings contradict the most probable place."""
        if len(newest) == 0 or belief.unknown > MOSTLY:
            return False
        index = np.unravel_index(int(belief.mass.argmax()), belief.mass.shape)
        pose = self.places.grid.world_pose(*(float(i) for i in index))
        fit = share_explained(
            newest, pose[None], self.kinds, self.kind_of_sonar, self.places.grid, self.config.fit
        )
        return float(fit[0]) < self.config.carried.explained

    def scores(self, prior: PoseBelief, segment: Segment) -> ScoreArray:
        """The log-likelihood ratio of a segment at every pose (headings, rows, cols)."""
        return score_poses(
            segment, self.kinds, self.kind_of_sonar, self.places.grid, self.places.blocks,
            prior.mass, self.config.observation,
        )  # fmt: skip

    def best_possible(self, segment: Segment) -> float:
        """The score of a place where every reading is exactly what it should be."""
        kind = self.kind_of_sonar[segment.sonar]
        return float(
            sum(
                np.log(sonar.table.max(axis=2).sum(axis=1))[segment.codes[kind == k]].sum()
                for k, sonar in enumerate(self.kinds)
            )
        )

    def _step(self, state: PoseGridState, segment: Segment, t: float) -> LocalizationStep:
        places, belief = self.places, state.belief
        probabilities = node_probabilities(belief, places, self.config.nodes)
        poses = best_poses(belief, places, self.config.nodes)
        fits = share_explained(
            segment, poses, self.kinds, self.kind_of_sonar, places.grid, self.config.fit
        )
        best = int(probabilities.argmax())
        return LocalizationStep(
            state.steps,
            t,
            dict(zip(places.nodes, probabilities.tolist(), strict=True)),
            belief.unknown,
            places.nodes[best],
            poses[best],
            entropy_of(probabilities / max(probabilities.sum(), 1e-12)),
            len(segment) > 0,
            _candidates(places.nodes, poses, fits),
            segment.echo_points(),
            explain(places.names, probabilities, belief.unknown, fits, segment.distance, poses),
        )


def _candidates(
    nodes: tuple[str, ...], poses: FloatArray, fits: FloatArray
) -> dict[str, Candidate]:
    return {
        node: Candidate(poses[i], float(fits[i]))
        for i, node in enumerate(nodes)
        if np.isfinite(poses[i]).all()
    }
