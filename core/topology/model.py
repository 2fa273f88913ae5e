"""A model: everything that is known of a home after modelling."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from core.geometry import IntArray
from core.mapping import OccupancyGrid
from core.mapping.drift_view import DriftView
from core.sensing import Trajectory
from core.topology.topological_map import TopologicalMap


@dataclass(frozen=True)
class Model:
    """A modelled home.

    Attributes:
        grid: the occupancy grid, in the log's odometry frame.
        regions: (rows, cols) region of each cell, 0 = none; row 0 is the lowest y, like the grid.
        rooms: (rows, cols) room of each cell, 0 = none.
        topology: nodes, edges, rooms; the truth about labels.
        trajectory: the poses that the map was made at; None for a map that was imported.
        provenance: inputs, every parameter of every stage, versions.
        history: the steps and decisions that made the regions, in order.
        timeline: the picture (PNG, `segmentation/step_picture.py`) of each step in the history;
            none for models that no drive has made.
        drift: the drive before and after its correction; None for a map that was imported.
    """

    grid: OccupancyGrid
    regions: IntArray
    rooms: IntArray
    topology: TopologicalMap
    trajectory: Trajectory | None
    provenance: Mapping[str, Any]
    history: tuple[Mapping[str, Any], ...] = ()
    timeline: tuple[bytes, ...] = ()
    drift: DriftView | None = None
