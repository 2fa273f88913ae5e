"""From scans and a trajectory to an occupancy grid."""

from core.mapping.occupancy_grid import (
    DEFAULT_RESOLUTION,
    FREE,
    OCCUPIED,
    UNKNOWN,
    GridGeometry,
    OccupancyGrid,
)

__all__ = ["DEFAULT_RESOLUTION", "FREE", "OCCUPIED", "UNKNOWN", "GridGeometry", "OccupancyGrid"]
