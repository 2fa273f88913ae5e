"""CPU time of the default localization by free space: `python THIS`.

The paper's home as modelled by default, then hand-made flats of furnished rooms up to 1,100 m2, all
driven through by the same log. Prints the features of the map (made once per model) and an update.
"""

from __future__ import annotations

import time

import numpy as np

from core.localization.place_map import place_map
from core.localization.pose_grid_localizer import PoseGridConfig
from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import GridGeometry
from core.pipeline.localizer import Localizer
from core.pipeline.modeller import model_log
from core.sensing import RobotLog
from core.simulation import simulate
from core.topology import Model
from core.topology.topology_of import topology_of

RESOLUTION = 0.05
WIDTH, DEPTH = 4.0, 5.0
"""Of a room (m)."""
TILES = ((3, 2), (5, 3), (6, 5), (10, 6))


def flat(columns: int, rows: int, rng: np.random.Generator) -> Model:
    """Rooms side by side, each with a door to its neighbours and a piece of furniture."""
    shape = (round((rows * DEPTH + 1) / RESOLUTION), round((columns * WIDTH + 1) / RESOLUTION))
    geometry = GridGeometry(RESOLUTION, (-0.5, -0.5, 0.0), shape)
    x, y = np.moveaxis(geometry.world_of(np.moveaxis(np.indices(shape), 0, -1)), -1, 0)
    inside = (x > 0) & (x < columns * WIDTH) & (y > 0) & (y < rows * DEPTH)
    taken = (x % WIDTH < 0.1) | (y % DEPTH < 0.1)
    regions = np.zeros(shape, np.int64)
    for column in range(columns):
        for row in range(rows):
            left, low = column * WIDTH, row * DEPTH
            doors = rng.uniform(1, 3, 2)
            taken &= ~((abs(x - left) < 0.2) & (abs(y - low - doors[0]) < 0.45))
            taken &= ~((abs(y - low) < 0.2) & (abs(x - left - doors[1]) < 0.45))
            at, size = rng.uniform((0.5, 0.5), (3, 4)), rng.uniform(0.3, 1.2, 2)
            over_x = (x > left + at[0]) & (x < left + at[0] + size[0])
            taken |= over_x & (y > low + at[1]) & (y < low + at[1] + size[1])
            room = (x >= left) & (x < left + WIDTH) & (y >= low) & (y < low + DEPTH)
            regions[room] = column * rows + row + 1
    free = inside & ~taken
    grid = OccupancyGrid.of(geometry, free, ~free)
    regions[~free] = 0
    return Model(grid, regions, regions, topology_of(grid, regions), None, {})


def row(name: str, model: Model, log: RobotLog) -> str:
    """One line of the table."""
    config = PoseGridConfig()
    start = time.process_time()
    place_map(model, config.ranges, config.headings)
    features = time.process_time() - start
    localizer = Localizer(model, log.ring)
    state, updates = localizer.start(), []
    for scan in log.without_truth():
        start = time.process_time()
        state, step = localizer.advance(state, scan)
        if step is not None:
            updates.append(1e3 * (time.process_time() - start))
    area = float(model.grid.free.sum()) * RESOLUTION**2
    return (
        f"{name:10s} {area:5.0f} m2  features {features:4.2f} s  first update {updates[0]:5.0f} ms  "
        f"median {np.median(updates):4.0f} ms  {np.median(updates) / area:4.2f} ms/m2"
    )


def main() -> None:
    log = simulate("paper", seed=3, tour="localization")
    paper = model_log(simulate("paper", seed=3).without_truth())
    row("warm-up", paper, log)
    print(row("paper", paper, log), flush=True)
    for columns, rows in TILES:
        model = flat(columns, rows, np.random.default_rng(0))
        print(row(f"{columns} x {rows}", model, log), flush=True)


if __name__ == "__main__":
    main()
