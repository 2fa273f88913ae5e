"""The mapper: a drive and its trajectory in, an occupancy grid out."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

from core.errors import InputError, MapError
from core.mapping.bayes import BayesConfig, bayes_map
from core.mapping.cemal import CemalConfig, cemal_map
from core.mapping.map_result import MapResult
from core.mapping.occupancy_grid import DEFAULT_RESOLUTION
from core.progress import Progress, no_progress
from core.sensing import RobotLog, Trajectory

MappingMethod = Literal["cemal", "bayes"]
FINEST, COARSEST = 0.02, 0.5
"""Metres per cell: below, a sonar says nothing more; above, a doorway is one cell."""


@dataclass(frozen=True)
class MappingOptions:
    """What a user chooses for a map: method and metres per cell."""

    method: MappingMethod = "cemal"
    resolution: float = DEFAULT_RESOLUTION

    def __post_init__(self) -> None:
        if self.method not in ("cemal", "bayes"):
            raise InputError(f"mapping method {self.method!r}: choose cemal or bayes")
        if not FINEST <= self.resolution <= COARSEST:
            raise InputError(
                f"a resolution of {self.resolution:g} m: choose from {FINEST} to {COARSEST} m"
            )

    def parameters(self) -> dict[str, Any]:
        """Every parameter of the chosen method, for the provenance."""
        return {"method": self.method, **asdict(self._config())}

    def _config(self) -> CemalConfig | BayesConfig:
        if self.method == "bayes":
            return BayesConfig(resolution=self.resolution)
        return CemalConfig(resolution=self.resolution)


def map_log(
    log: RobotLog,
    trajectory: Trajectory,
    options: MappingOptions | None = None,
    progress: Progress = no_progress,
) -> MapResult:
    """The map of a drive at the poses of a trajectory.

    Raises:
        MapError: the log has no echo at all, or the drive is too large for a grid.
    """
    result = map_scans(log, trajectory, options or MappingOptions(), progress)
    if not result.kept.any():
        raise MapError(
            f"log {log.name!r} has no usable echo: there is nothing to map. Check the no-echo value "
            "and the units of the ranges"
        )
    return result


def map_scans(
    log: RobotLog,
    trajectory: Trajectory,
    options: MappingOptions,
    progress: Progress = no_progress,
) -> MapResult:
    """The map of scans that may hold no echo at all; then only what the robot covers is free."""
    config = options._config()
    if isinstance(config, BayesConfig):
        return bayes_map(log, trajectory, config, progress)
    return cemal_map(log, trajectory, config, progress)
