"""Parameters of the drift correction as a whole; those of its stages sit beside them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from core.mapping.loop_closure import ClosureConfig
from core.mapping.matching_config import MatchingConfig
from core.mapping.odometry_model import OdometryNoise
from core.mapping.point_alignment import AlignmentConfig
from core.mapping.pose_graph import GraphConfig
from core.mapping.reflection_points import ReflectionConfig
from core.mapping.wall_direction import WallDirectionConfig


@dataclass(frozen=True)
class DriftConfig:
    """Parameters of the whole; those of the stages sit beside them.

    Attributes:
        spacing: travel between two nodes (m).
        half_span: a submap reaches this many nodes, and a half, to both sides.
        apart: nodes at least this far apart are tried against each other.
        wall_span: travel before and after a node from which its walls are seen (m).
        aligned_wall_sigma: standard deviation of a wall direction while visits are aligned (rad): the
            nodes are denser then, and see the same walls more often.
        use_walls: the walls' directions count (the Manhattan assumption).
        kept_closure_weight: share of its information that a closure keeps while visits are aligned,
            which says the same more sharply.
        refinement: nodes per `spacing` while visits are aligned.
    """

    spacing: float = 1.5
    half_span: int = 2
    apart: int = 6
    wall_span: float = 5.0
    aligned_wall_sigma: float = math.radians(3.75)
    use_walls: bool = True
    kept_closure_weight: float = 0.05
    refinement: int = 2
    reflection: ReflectionConfig = field(default_factory=ReflectionConfig)
    matching: MatchingConfig = field(default_factory=MatchingConfig)
    closure: ClosureConfig = field(default_factory=ClosureConfig)
    walls: WallDirectionConfig = field(default_factory=WallDirectionConfig)
    graph: GraphConfig = field(default_factory=GraphConfig)
    alignment: AlignmentConfig = field(default_factory=AlignmentConfig)
    noise: OdometryNoise = field(default_factory=OdometryNoise)
