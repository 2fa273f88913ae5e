"""How long a floor plan of five megapixels takes, stage by stage, and how much memory.

    python tests/benchmarks/large_plan.py [--columns 2600 --rows 1950]

The plan is drawn here: corridors with furnished rooms on both sides, 5 cm a pixel. Wall and
processor seconds and peak memory of `echorooms model plan/map.yaml` as a process of its own, then the
processor seconds of each stage (compiled loops are warm).
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np

from core.geometry import BoolArray
from core.mapping import GridGeometry, OccupancyGrid
from core.mapping.map_server import read_map, write_map
from core.pipeline.modeller import model_map
from core.segmentation.automatic import AutomaticConfig, draft_of, segment_automatically
from core.topology.model_folder import write_model
from core.topology.topology_of import topology_of

Value = TypeVar("Value")
COMMAND = [sys.executable, "-c", "from app.cli import main; main()"]
RESOLUTION = 0.05
MARGIN, WALL, DOOR, CORRIDOR = 30, 3, 18, 48
ROOM_DEPTH, ROOM_WIDTH = (120, 180), (90, 200)
"""Cells, drawn between both."""
FURNITURE, FURNITURE_SIZE = 5, (8, 36)
"""Pieces a room, and the cells of their sides."""


def floor_plan(rows: int, cols: int, seed: int = 0) -> tuple[OccupancyGrid, int]:
    """A plan of that many pixels and the number of its rooms."""
    rng = np.random.default_rng(seed)
    free = np.zeros((rows, cols), bool)
    occupied = np.zeros((rows, cols), bool)
    occupied[MARGIN:-MARGIN, MARGIN:-MARGIN] = True
    left, right = MARGIN + WALL + CORRIDOR + WALL, cols - MARGIN - WALL
    row, count, corridors = MARGIN + WALL, 0, []
    while True:
        below, above = rng.integers(*ROOM_DEPTH, size=2)
        corridor = row + below + WALL
        last = corridor + CORRIDOR + WALL + above
        if last > rows - MARGIN - WALL:
            break
        count += _row_of_rooms(free, rng, (row, row + below), (left, right), row + below)
        count += _row_of_rooms(free, rng, (last - above, last), (left, right), last - above - WALL)
        free[corridor : corridor + CORRIDOR, MARGIN + WALL : right] = True
        corridors.append(corridor)
        row = last + WALL
    free[corridors[0] : corridors[-1] + CORRIDOR, MARGIN + WALL : left - WALL] = True
    occupied[row:] = False
    geometry = GridGeometry(RESOLUTION, (0.0, 0.0, 0.0), (rows, cols))
    return OccupancyGrid.of(geometry, free, occupied & ~free), count


def _row_of_rooms(
    free: BoolArray,
    rng: np.random.Generator,
    rows: tuple[int, int],
    cols: tuple[int, int],
    door_row: int,
) -> int:
    """Draws furnished rooms side by side, each with a door in the wall at `door_row`; how many."""
    col, count = cols[0], 0
    while (end := col + int(rng.integers(*ROOM_WIDTH))) <= cols[1]:
        free[rows[0] : rows[1], col:end] = True
        for _ in range(FURNITURE):
            height, width = rng.integers(*FURNITURE_SIZE, size=2)
            corner = rng.integers((rows[0], col), (rows[1] - height, end - width))
            free[corner[0] : corner[0] + height, corner[1] : corner[1] + width] = False
        door = int(rng.integers(col, end - DOOR))
        inner = (
            slice(rows[0], rows[0] + DOOR) if door_row < rows[0] else slice(rows[1] - DOOR, None)
        )
        free[inner.start : inner.stop or rows[1], door : door + DOOR] = True
        free[door_row : door_row + WALL, door : door + DOOR] = True
        col, count = end + WALL, count + 1
    return count


def timed(name: str, call: Callable[[], Value]) -> Value:
    """Calls and prints the processor seconds."""
    start = time.process_time()
    value = call()
    sys.stdout.write(f"{name:<46}{time.process_time() - start:>9.2f}\n")
    sys.stdout.flush()
    return value


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=1950)
    parser.add_argument("--columns", type=int, default=2600)
    options = parser.parse_args()
    plan, rooms = floor_plan(options.rows, options.columns)
    small, _ = floor_plan(500, 500)
    model_map(small)  # compiles
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "plan").mkdir()
        write_map(plan, folder / "plan")
        sys.stdout.write(f"{plan.free.size / 1e6:.1f} megapixels, {rooms} rooms\n")
        command(folder)  # first: a child's peak memory begins at its parent's
        sys.stdout.write(f"{'stage':<46}{'CPU s':>9}\n")
        stages(folder)


def stages(folder: Path) -> None:
    """Prints a row for each stage."""
    grid = timed("read the map", lambda: read_map(folder / "plan" / "map.yaml"))
    config = AutomaticConfig()
    timed(
        "  draft cells",
        lambda: draft_of(grid.free, grid.occupied, RESOLUTION, config.draft, config.clutter),
    )
    found = timed("rooms and regions", lambda: segment_automatically(grid))
    timed("topology", lambda: topology_of(grid, found.regions, found.rooms))
    model = timed("model of the map, all of the above", lambda: model_map(grid))
    timed("write the model folder", lambda: write_model(model, folder / "model"))
    sys.stdout.write(f"{found.rooms.max()} rooms found, {found.regions.max()} regions\n")


def command(folder: Path) -> None:
    """Prints what `echorooms model` takes in a process of its own."""
    start = time.perf_counter()
    subprocess.run(
        [*COMMAND, "model", folder / "plan" / "map.yaml", "--out", folder / "made"],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    wall = time.perf_counter() - start
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    sys.stdout.write(
        f"echorooms model: {wall:.1f} s wall, {used.ru_utime + used.ru_stime:.1f} s CPU, "
        f"{used.ru_maxrss / 1024:.0f} MB\n"
    )


if __name__ == "__main__":
    main()
