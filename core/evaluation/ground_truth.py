"""What the metrics compare with: the truth of a home on a grid, explored part and doors included."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import BoolArray, FloatArray, IntArray, compose, rigid_fit
from core.mapping.occupancy_grid import GridGeometry, OccupancyGrid


@dataclass(frozen=True)
class GroundTruth:
    """The truth of a home (row 0 = lowest y).

    Attributes:
        geometry: where the cells lie in the world.
        occupied: (rows, cols) walls, furniture, outside.
        free: (rows, cols) open floor.
        explored: (rows, cols) floor that the drive has swept; only there a map can be right.
        rooms: (rows, cols) label image, 0 = none, k = `names[k - 1]`.
        names: of the rooms.
        doors: (D, 4) `x0, y0, x1, y1` in metres: the gaps in the walls.
    """

    geometry: GridGeometry
    occupied: BoolArray
    free: BoolArray
    explored: BoolArray
    rooms: IntArray
    names: tuple[str, ...]
    doors: FloatArray

    def padded(self, margin: float) -> GroundTruth:
        """The same truth with `margin` metres more around it, all of it occupied."""
        geometry = self.geometry
        n = round(margin / geometry.resolution)
        x, y, heading = geometry.origin
        shift = n * geometry.resolution
        return GroundTruth(
            GridGeometry(
                geometry.resolution,
                (x - shift, y - shift, heading),
                (geometry.shape[0] + 2 * n, geometry.shape[1] + 2 * n),
            ),
            np.pad(self.occupied, n, constant_values=True),
            np.pad(self.free, n),
            np.pad(self.explored, n),
            np.pad(self.rooms, n),
            self.names,
            self.doors,
        )

    def centres(self) -> FloatArray:
        """World positions (rows, cols, 2) of the centres of all cells."""
        return self.geometry.world_of(np.moveaxis(np.indices(self.geometry.shape), 0, -1))


def alignment(truth_poses: FloatArray, map_poses: FloatArray) -> FloatArray:
    """`pose_truth_map` (3,): the one rigid motion that lays the trajectory of a map on the true one.

    Drift bends a map; where its frame lies is nobody's merit or fault. Use it for maps of our own
    homes, as `aligned(grid.geometry, alignment(log.truth, trajectory.poses))`.

    Args:
        truth_poses: (N, 3) true poses of the mapping drive.
        map_poses: (N, 3) the poses that the map was made at.
    """
    return rigid_fit(truth_poses[:, :2], map_poses[:, :2])


def aligned(geometry: GridGeometry, pose_truth_map: FloatArray) -> GridGeometry:
    """The geometry of a map's grid, seen from the truth's frame."""
    x, y, heading = compose(pose_truth_map, np.array(geometry.origin))
    return GridGeometry(geometry.resolution, (float(x), float(y), float(heading)), geometry.shape)


def aligned_grid(grid: OccupancyGrid, pose_truth_map: FloatArray) -> OccupancyGrid:
    """The same map with its grid seen from the truth's frame."""
    return OccupancyGrid(aligned(grid.geometry, pose_truth_map), grid.state)


def sampled(
    image: BoolArray | IntArray | FloatArray,
    geometry: GridGeometry,
    points: FloatArray,
    fill: float,
) -> FloatArray:
    """Values of an image (rows, cols) at world points (..., 2); `fill` outside."""
    cells = geometry.cell_of(points)
    inside = geometry.contains(cells)
    out = np.full(points.shape[:-1], fill)
    out[inside] = image[cells[inside][:, 0], cells[inside][:, 1]]
    return out
