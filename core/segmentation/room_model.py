"""How good a room a region would make, all in all: what a border alone does not tell.

Extremely randomized trees over the features of `room_features.py`, fitted by
`tests/benchmarks/rooms_fit.py` to all regions that come up while draft cells merge.
"""

from __future__ import annotations

from dataclasses import dataclass

from core.geometry import FloatArray
from core.segmentation.decision_forest import DecisionForest, stored_forest

STORED = "room_model.npz"
EXPECTED = 0.45
"""About half the panoptic quality that can be reached. A region must promise more to pay for itself:
quality is the sum of what the regions promise by their number, and where the sum of (promise - t / 2)
is largest, so is the quality t (Dinkelbach, 1967)."""


@dataclass(frozen=True)
class RoomModel:
    """The trees."""

    forest: DecisionForest

    def worth(self, features: FloatArray) -> FloatArray:
        """What regions (n, f) add as rooms (n,): the overlap (IoU) that each promises with a true
        room, counted 0 up to one half as panoptic quality does, less `EXPECTED`."""
        return self.forest.mean(features) - EXPECTED


def stored_room_model() -> RoomModel:
    """The model that the program uses."""
    return RoomModel(stored_forest(STORED))
