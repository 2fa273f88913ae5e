"""What autonomous modelling knows between two steps: the extracted regions and their lineage."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.geometry import IntArray
from core.mapping import GridGeometry
from core.segmentation.decision import Decision
from core.segmentation.moment import Moment
from core.segmentation.step_picture import StepPicture


@dataclass(frozen=True)
class ExtractedRegion:
    """A region that has been taken out of the remaining space.

    Attributes:
        number: its identity, never used again.
        cells: (n, 2) its cells on the lattice of the world (`lattice_corner`), so that the region
            stays where it is when the grid grows.
        parents: numbers of the regions that it was split from or merged of.
        is_open: the robot is back in it: it takes part in segmentation again, its number waits.
    """

    number: int
    cells: IntArray
    parents: tuple[int, ...] = ()
    is_open: bool = False


@dataclass(frozen=True)
class ExtractionState:
    """The extracted regions and how they came about.

    Attributes:
        regions: in order of extraction.
        next_number: the first number that no region has used.
        history: every step (`event` "step") followed by its decisions and events.
        pictures: one `StepPicture` as PNG for each step.
    """

    regions: tuple[ExtractedRegion, ...] = ()
    next_number: int = 1
    history: tuple[Mapping[str, Any], ...] = ()
    pictures: tuple[bytes, ...] = ()

    @property
    def closed(self) -> tuple[ExtractedRegion, ...]:
        """The regions that are left alone."""
        return tuple(region for region in self.regions if not region.is_open)

    def recorded(
        self,
        moment: Moment,
        clusters: IntArray,
        decisions: list[Decision],
        thresholds: Mapping[str, float | None],
        said: str,
    ) -> ExtractionState:
        """The state with a step in its history.

        Args:
            moment: of the step.
            clusters: (rows, cols) the tentative parts by number.
            decisions: one for each part that was looked at.
            thresholds: what the measures were held against.
            said: what the step came to, in words.
        """
        step, t, geometry = len(self.pictures), round(moment.t, 2), moment.grid.geometry
        head = {
            "event": "step",
            "step": step,
            "t": t,
            "distance_m": round(moment.distance, 3),
            "pose": [round(float(v), 4) for v in moment.pose],
            "picture": {"origin": list(geometry.origin), "resolution": geometry.resolution},
            "thresholds": dict(thresholds),
            "said": said,
        }
        entries = [{"step": step, "t": t, **decision.entry()} for decision in decisions]
        regions = np.where(moment.grid.free, painted(self.regions, geometry), 0)
        picture = StepPicture(moment.grid.state, clusters, regions).png()
        return replace(
            self,
            history=(*self.history, head, *entries),
            pictures=(*self.pictures, picture),
        )


def lattice_corner(geometry: GridGeometry) -> IntArray:
    """`[row, col]` of a grid's cell [0, 0] on the lattice of all grids of this resolution."""
    x, y = geometry.origin[:2]
    return np.rint(np.array([y, x]) / geometry.resolution).astype(np.int64)


def painted(regions: tuple[ExtractedRegion, ...], geometry: GridGeometry) -> IntArray:
    """Label image (rows, cols) of regions by their numbers, 0 = none."""
    labels = np.zeros(geometry.shape, np.int64)
    corner = lattice_corner(geometry)
    for region in regions:
        cells = region.cells - corner
        cells = cells[geometry.contains(cells)]
        labels[cells[:, 0], cells[:, 1]] = region.number
    return labels
