"""CEMAL scan by scan, for live mapping: the same map as `cemal_map` of the scans so far.

The batch goes through rounds; in each, readings are judged and some are dropped. Here every reading
keeps its timeline: the round in which it is dropped (NEVER for those on the map), the round from
which on it is in no conflict, and the rounds in which it wins, with the cell that it then defends. A
new reading changes the timelines of few others (typically under a hundred of 28000), and those are
worked out anew, earliest round first, until none changes. As the state of a round depends on
earlier rounds only, that ends at the batch's own result.

The batch drops losers once no winner attacks any more, anywhere. Conflicts are local, so a place that
is done may as well wait: a phase has PHASE rounds, losers are dropped in its last one.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from core.geometry import BoolArray, FloatArray, compose
from core.mapping.beam_footprint import BeamFootprints, beam_capacity, frame_of
from core.mapping.cemal import CemalConfig
from core.mapping.conflict_kernels import defended_cells, settle
from core.mapping.conflict_ledger import (
    TILE,
    corner_in,
    extended,
    moved_cells,
    moved_numbers,
    moved_tiles,
    new_beams,
    new_cells,
    new_queue,
    new_tiles,
    with_chunks,
    with_places,
    with_room,
)
from core.mapping.map_result import MapResult, check_size, cropped
from core.mapping.occupancy_grid import GridGeometry, OccupancyGrid
from core.mapping.robot_footprint import driven_over
from core.sensing import Scan, SonarRing

FIRST_ROOM = 1024
"""Readings that there is room for at first."""
MOST_LOOKS = 4000
"""Readings looked at for one scan; what is left then waits for the next scan or for `result`."""
EMPTY = GridGeometry(1.0, (0.0, 0.0, 0.0), (0, 0))


class IncrementalCemal:
    """A growing map. Can be pickled between two scans and goes on from there."""

    def __init__(self, ring: SonarRing, config: CemalConfig | None = None) -> None:
        self.ring = ring
        self.config = config or CemalConfig()
        self.scans = 0
        self._footprints = BeamFootprints.of(ring)
        self._low = np.array([s.min_range for s in ring.sonars])
        self._high = np.array([s.max_range for s in ring.sonars])
        self._limits = np.array(
            [
                self.config.conflict_clearance,
                self.config.free_clearance,
                self.config.arc_half_thickness,
            ]
        )
        self._readings = 0
        self._geometry = EMPTY
        self._cells, self._beams = new_cells(0), new_beams(FIRST_ROOM)
        self._queue = new_queue(FIRST_ROOM)
        self._arcs, self._reach = new_tiles(0, 1), new_tiles(0, 1)
        self._under_robot = np.zeros((0, 0), bool)
        reach = float(self._high.max()) + self.config.arc_half_thickness
        size = beam_capacity(reach, float(self._footprints.half_beam.max()), self.config.resolution)
        self._scratch = np.empty(size, np.int64), np.empty(size), np.empty(size)
        self._spare_chunks = (int(2 * reach / (TILE * self.config.resolution)) + 3) ** 2

    def add(self, scan: Scan, pose: FloatArray) -> None:
        """Takes in a scan that was made at a pose (3,) of the map's frame.

        Raises:
            MapError: the drive has become too large for a grid; the map is as before.
        """
        with np.errstate(invalid="ignore"):
            usable = scan.fresh & (scan.ranges >= self._low) & (scan.ranges < self._high)
        sonar = np.flatnonzero(usable)
        ranges = scan.ranges[sonar]
        poses = compose(pose, self._footprints.mounting[sonar])
        self._make_room(np.asarray(pose, float), poses, ranges)
        self._drive_over(np.asarray(pose, float))
        first, last = self._readings, self._readings + len(sonar)
        beams, half = self._beams, self._footprints.half_beam[sonar]
        beams.pose[first:last] = poses
        beams.axis[first:last] = np.column_stack(
            (np.cos(poses[:, 2]), np.sin(poses[:, 2]), np.cos(half) ** 2)
        )
        beams.range_m[first:last] = ranges
        beams.sonar[first:last] = sonar
        beams.scan[first:last] = self.scans
        self._readings = last
        self.scans += 1
        self._settle(first, last, MOST_LOOKS)

    def result(self) -> MapResult:
        """The map of the scans so far; before the first one, a grid without cells."""
        while self._settle(self._readings, self._readings, MOST_LOOKS):
            continue
        cells, shape = self._cells, self._geometry.shape
        defended = defended_cells(
            self._readings,
            self._limits,
            cells,
            self._beams,
            self._reach,
            self._sensor(),
            self._scratch,
        )
        empty = cells.free > 0
        confidence = np.where(~empty & (cells.arcs > 0), cells.arc_pressure, 0.0)
        confidence = (confidence + np.where(empty, defended, 0.0)).reshape(shape)
        occupied = (confidence > 0) & ~self._under_robot
        free = (empty.reshape(shape) & ~occupied) | self._under_robot
        grid = OccupancyGrid.of(self._geometry, free, occupied)
        confidence = np.where(occupied, confidence, 0.0)
        witnesses = cells.free.astype(np.int64).reshape(shape)
        return cropped(MapResult(grid, confidence, self._kept(), witnesses))

    def _kept(self) -> BoolArray:
        kept = np.zeros((self.scans, len(self.ring)), bool)
        shown = np.flatnonzero(self._beams.shown[: self._readings])
        kept[self._beams.scan[shown], self._beams.sonar[shown]] = True
        return kept

    def _settle(self, first: int, last: int, budget: int) -> int:
        """Brings timelines up to date; returns at how many it has looked."""
        done = 0
        while True:
            self._arcs = with_chunks(self._arcs, self._spare_chunks)
            self._reach = with_chunks(self._reach, self._spare_chunks)
            looked, hungry = settle(
                first,
                last,
                budget - done,
                self._spare_chunks,
                self._limits,
                self._cells,
                self._beams,
                self._arcs,
                self._reach,
                self._queue,
                self._sensor(),
                self._scratch,
            )
            done, first = done + int(looked), last
            if not hungry:
                return done

    def _sensor(self) -> tuple[Any, ...]:
        frame, shape = frame_of(self._geometry)
        return self._footprints.half_beam, self._footprints.gain, frame, shape

    def _make_room(self, pose: FloatArray, poses: FloatArray, ranges: FloatArray) -> None:
        """Lets grid and arrays grow where the next scan needs it."""
        margin = max(self.ring.robot_radius, 0.0) + 2 * self.config.resolution
        reach = (ranges + 2 * self.config.resolution)[:, None]
        points = np.concatenate(
            ([pose[:2] - margin, pose[:2] + margin], poses[:, :2] - reach, poses[:, :2] + reach)
        )
        old = self._geometry
        new = extended(old if old.shape[0] else None, points, self.config.resolution)
        check_size(new)
        self._beams = with_room(self._beams, self._readings + len(ranges))
        self._queue = with_places(self._queue, len(self._beams.range_m))
        if new == old:
            return
        if old.shape[0] == 0:
            tiles = new.shape[0] // TILE * (new.shape[1] // TILE)
            self._cells = new_cells(new.shape[0] * new.shape[1])
            self._arcs, self._reach = (new_tiles(tiles, self._spare_chunks) for _ in range(2))
            self._under_robot = np.zeros(new.shape, bool)
        else:
            self._move(old, new)
        self._geometry = new

    def _move(self, old: GridGeometry, new: GridGeometry) -> None:
        self._cells = moved_cells(self._cells, old, new)
        self._arcs = moved_tiles(self._arcs, old, new)
        self._reach = moved_tiles(self._reach, old, new)
        beams = self._beams
        self._beams = beams._replace(
            watched=moved_numbers(beams.watched, old, new),
            seen_at=moved_numbers(beams.seen_at, old, new),
            win_cell=moved_numbers(beams.win_cell, old, new),
        )
        (row, col), (rows, cols) = corner_in(old, new), old.shape
        under_robot = np.zeros(new.shape, bool)
        under_robot[row : row + rows, col : col + cols] = self._under_robot
        self._under_robot = under_robot

    def _drive_over(self, pose: FloatArray) -> None:
        """Notes the cells under the robot."""
        geometry, side = self._geometry, self._geometry.resolution
        reach = int(np.ceil(self.ring.robot_radius / side)) + 2
        low = np.maximum(geometry.cell_of(pose[:2]) - reach, 0)
        part = self._under_robot[low[0] :, low[1] :][: 2 * reach + 1, : 2 * reach + 1]
        corner = (geometry.origin[0] + low[1] * side, geometry.origin[1] + low[0] * side, 0.0)
        window = GridGeometry(side, corner, (part.shape[0], part.shape[1]))
        part |= driven_over(window, pose[None], self.ring.robot_radius)
