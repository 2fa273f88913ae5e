"""One decision of autonomous extraction with everything that a person needs to see why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from core.geometry import BoolArray, FloatArray
from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.convex_hull import convex_hull
from core.segmentation.convexity import ConvexityConfig, convexity, rim_of
from core.segmentation.cut_polyline import cut_polylines

Polyline = list[list[float]]


@dataclass(frozen=True)
class CutMeasures:
    """What is measured of a part that might be cut off the space that is left.

    Attributes:
        c1: eq. (7) of all that is left.
        c2: eq. (8) of the part and the rest.
        ncut: normalized cut: the border's grids per grid of the part, plus per grid of the rest.
        cut_width_m: length of the border.
        cut: the border, one polyline of world points (x, y) a stretch.
        hull: corners of the part's convex hull, world points.
    """

    c1: float
    c2: float
    ncut: float
    cut_width_m: float
    cut: list[Polyline]
    hull: Polyline


def measure_cut(
    part: BoolArray, left: BoolArray, c1: float, grid: OccupancyGrid, config: ConvexityConfig
) -> CutMeasures:
    """Measures of cutting a part off what is left.

    Args:
        part: (rows, cols), lies in `left`.
        left: (rows, cols) the space that is being divided.
        c1: eq. (7) of `left`.
        grid: the map.
        config: what eq. (7) counts.
    """
    rest = left & ~part
    lines, length = cut_polylines(part, rest)
    ncut = sum(length / int(side.sum()) for side in (part, rest) if side.any())
    c2 = convexity((part, rest), grid, config) if rest.any() else c1
    hull = convex_hull(rim_of(part))
    return CutMeasures(
        c1,
        c2,
        ncut,
        length * grid.geometry.resolution,
        [_in_world(line, grid.geometry) for line in lines],
        _in_world(hull, grid.geometry),
    )


def _in_world(cells: FloatArray, geometry: GridGeometry) -> Polyline:
    return [[round(float(x), 3), round(float(y), 3)] for x, y in geometry.world_of(cells)]


@dataclass(frozen=True)
class Decision:
    """Whether a part became a region, and why.

    Attributes:
        cluster: its number in the picture of the step.
        measures: see there.
        hidden_pairs: of the part.
        accepted: it became a region.
        reason: why, or why not, in words.
        region: number of the region that it became.
        came_from: numbers of the regions that it was cut from.
    """

    cluster: int
    measures: CutMeasures
    hidden_pairs: float
    accepted: bool
    reason: str
    region: int | None = None
    came_from: tuple[int, ...] = ()

    def entry(self) -> dict[str, Any]:
        """As it stands in the history."""
        measured = self.measures
        return {
            "event": "extract",
            "cluster": self.cluster,
            "c1": round(measured.c1, 3),
            "c2": round(measured.c2, 3),
            "hidden_pairs": round(self.hidden_pairs, 3),
            "ncut": round(measured.ncut, 4),
            "cut_width_m": round(measured.cut_width_m, 2),
            "cut": measured.cut,
            "hull": measured.hull,
            "accepted": self.accepted,
            "reason": self.reason,
            "region": self.region,
            "came_from": list(self.came_from),
        }
