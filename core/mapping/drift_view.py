"""What is kept beside a model to look at the drift of its drive, and to say something about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

DRIFT_FILE = "drift.json"
ODOMETRY_MAP_FILE = "odometry_map.png"


@dataclass(frozen=True)
class DriftView:
    """A drive before and after its correction.

    Attributes:
        report: `edits` (what a person said), `trajectory` (rows of t, corrected x, y, heading, odometry
            x, y, heading), `map` and `odometry_map` (`origin`, `resolution`, `shape` of the pictures).
            What was found is in the provenance.
        odometry_map: PNG of the map at the odometry as it is, in the colours and the orientation of
            map.pgm; None where that is too large to be a map.
    """

    report: Mapping[str, Any]
    odometry_map: bytes | None
