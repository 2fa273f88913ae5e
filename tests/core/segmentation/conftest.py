"""Maps drawn by hand, 5 cm a grid: `#` wall, `.` floor, one character for 0.25 m x 0.25 m."""

from __future__ import annotations

import numpy as np
import pytest

from core.mapping import GridGeometry, OccupancyGrid

RESOLUTION = 0.05
BLOCK = 5


def grid_of(drawing: list[str]) -> OccupancyGrid:
    """The map of a drawing; its last line is the lowest row."""
    characters = np.array([list(line) for line in drawing[::-1]])
    state = np.kron(np.where(characters == ".", 1, 2), np.ones((BLOCK, BLOCK), int))
    state = np.pad(state, BLOCK).astype(np.uint8)
    geometry = GridGeometry(RESOLUTION, (0.0, 0.0, 0.0), state.shape)
    return OccupancyGrid(geometry, state)


def room(rows: int, cols: int) -> list[str]:
    """A closed rectangular room."""
    return ["#" * (cols + 2), *["#" + "." * cols + "#" for _ in range(rows)], "#" * (cols + 2)]


@pytest.fixture(scope="session")
def two_rooms() -> OccupancyGrid:
    """Two rooms of 4 m x 3.5 m with a door of 0.75 m in the wall between them."""
    lines = room(14, 33)
    for i in range(1, 15):
        middle = "." if i in (7, 8, 9) else "#"
        lines[i] = lines[i][:17] + middle + lines[i][18:]
    return grid_of(lines)


@pytest.fixture(scope="session")
def l_shape() -> OccupancyGrid:
    """An L of two arms, 6 m long and 2 m wide."""
    lines = ["#" * 26]
    lines += ["#" + "." * 8 + "#" * 17 for _ in range(16)]
    lines += ["#" + "." * 24 + "#" for _ in range(8)]
    return grid_of([*lines, "#" * 26])


@pytest.fixture(scope="session")
def corridor_with_three_rooms() -> OccupancyGrid:
    """Three rooms of 3 m x 3 m, each with a door of 0.75 m to a corridor of 1.5 m x 9.5 m."""
    lines = ["#" * 40]
    lines += [("#" + "." * 12) * 3 + "#" for _ in range(12)]
    lines += [("#" * 5 + "..." + "#" * 5) * 3 + "#"]
    lines += ["#" + "." * 38 + "#" for _ in range(6)]
    return grid_of([*lines, "#" * 40])


@pytest.fixture(scope="session")
def square_map() -> OccupancyGrid:
    """A closed room of 3.5 m x 3.5 m."""
    return grid_of(room(14, 14))
