"""Tracing the boundary of free space (paper, 3.2.1; Gonzalez and Woods, 2002)."""

from __future__ import annotations

import numpy as np

from core.geometry import BoolArray, IntArray

CLOCKWISE = np.array([(0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1)])
"""The eight neighbours `[row, col]` in order of turning."""


def trace_boundary(mask: BoolArray) -> IntArray:
    """The outer boundary of a connected mask as a closed sequence of its own cells.

    Moore neighbour tracing: from each boundary cell on, the neighbours are looked at in order of
    turning, beginning behind the cell that one came from, until the first pair of cells comes up
    again (Jacob's criterion).

    Args:
        mask: (rows, cols), 8-connected and not empty.

    Returns:
        (n, 2) cells `[row, col]`, each an 8-neighbour of the next and the last one of the first.
    """
    padded = np.pad(mask, 1)
    start = np.argwhere(padded)[0]
    path = [start]
    # The start is the first in reading order, so the cell before it in its row is outside.
    direction, cell = 4, start
    first_move: tuple[int, int, int] | None = None
    while True:
        for turn in range(1, 9):
            way = (direction + turn) % 8
            step = cell + CLOCKWISE[way]
            if padded[tuple(step)]:
                break
        else:
            return np.asarray(start[None] - 1)
        move = (int(cell[0]), int(cell[1]), way)
        if first_move is None:
            first_move = move
        elif move == first_move:
            return np.stack(path[:-1]) - 1
        cell = step
        path.append(cell)
        direction = (way + 4) % 8
