"""The paper's extraction (3.2) with its open points as options.

The figures are means over twelve simulated homes (random-201 ... random-212) at corrected odometry,
one option changed at a time; as it stands purity is .92 and the adjusted Rand index (ARI) .56.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from core.segmentation.convexity import ConvexityConfig
from core.segmentation.reliable_region import ReliableConfig


@dataclass(frozen=True)
class PaperConfig:
    """Parameters of the paper's extraction.

    Attributes:
        step: metres of travel between two steps; the paper names none. With 1.25 m ARI is .52.
        window: metres of travel that the local map holds: a sliding window measured better than
            all data so far in two of three homes; None takes all.
        reliable: of the reliable region (eq. 6).
        convexity: of the condition (eq. 7-9).
        most_frontier: share of the farther cluster's rim that may be unexplored. The paper takes
            it that this cluster has "been updated sufficiently"; None as printed extracts fans of
            single readings (purity .91, ARI .54).
        reopening: what "unless the robot navigates back" means. "for_good": the region is part of
            the space that is left until something is extracted anew: half a home can end as one
            region (.90, .61, three regions in one of 16 drives through the paper's home).
            "while_inside": only as long as the robot is in it; what is convex with it joins it.
        at_end: of the space that is left when the drive ends. "pieces": every connected piece is a
            region (.92, .56, but .14 instead of .13 hidden pairs). "cut": the pieces are cut on, by
            the same conditions.
        least_area: square metres of a cluster; the paper tells of none. With 2 m2 purity is .94
            and ARI .53.
        max_cell: largest quadtree cell in grids.
    """

    step: float = 2.5
    window: float | None = 12.0
    reliable: ReliableConfig = field(default_factory=ReliableConfig)
    convexity: ConvexityConfig = field(default_factory=ConvexityConfig)
    most_frontier: float | None = 0.1
    reopening: Literal["for_good", "while_inside"] = "while_inside"
    at_end: Literal["pieces", "cut"] = "cut"
    least_area: float = 3.0
    max_cell: int = 32
