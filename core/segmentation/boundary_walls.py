"""Walls around a border: beside its ends, in line with it, and at right angles to it.

A frame is the middle of a border and its direction: row, col, d_row, d_col (cells). The lengths
belong to the features that the boundary model was fitted to: other values need another fit.
"""

from __future__ import annotations

import math

import numba
import numpy as np

from core.segmentation.map_probe import free_run, value_at

JAMB, JAMB_START = 0.6, 0.1
"""Metres of wall looked for just beside the border, and where that begins."""
WALL_REACH = 2.0
"""Metres of wall looked for in line with the border."""
LINE_REACH = 8.0
"""Metres within which all wall in line with the border counts: long walls go on behind openings."""
TURNS, TURN = 4, 2 * math.pi / 180
SHIFTS, SHIFT = 3, 0.05
"""The line of the wall may be turned (steps, radians) and shifted (steps, metres) a little."""
FLUSH = 0.2
"""Metres by which a wall may lie off the end of the border and still goes on from it."""
FLUSH_START, FLUSH_REACH = 0.2, 2.5
"""Metres from the border between which such walls are looked for."""


@numba.njit(cache=True)
def jambs(frame, length, floor, resolution):  # type: ignore[no-untyped-def]
    """jamb_low, jamb_high."""
    row, col, dr, dc = frame
    count, start = int(JAMB / resolution), max(1, int(JAMB_START / resolution))
    share = np.zeros(2)
    for side in range(2):
        sign = 1 - 2 * side
        for k in range(count):
            at = sign * (length / 2 + start + k)
            if not value_at(floor, row + at * dr, col + at * dc):
                share[side] += 1 / max(count, 1)
    return share.min(), share.max()


@numba.njit(cache=True)
def walls_in_line(frame, length, wall, resolution):  # type: ignore[no-untyped-def]
    """wall_low, wall_high, wall_line on the best of the slightly turned and shifted lines."""
    row, col, dr, dc = frame
    count, far = int(WALL_REACH / resolution), int(LINE_REACH / resolution)
    best, low, high, line = -1.0, 0.0, 0.0, 0.0
    for turn in range(-TURNS, TURNS + 1):
        cos, sin = math.cos(turn * TURN), math.sin(turn * TURN)
        er, ec = cos * dr - sin * dc, cos * dc + sin * dr
        for shift in range(-SHIFTS, SHIFTS + 1):
            off = shift * SHIFT / resolution
            r, c = row - off * dc, col + off * dr
            ahead, back, total = 0.0, 0.0, 0.0
            for k in range(far):
                at = length / 2 + 1 + k
                a = value_at(wall, r + at * er, c + at * ec)
                b = value_at(wall, r - at * er, c - at * ec)
                total += a + b
                if k < count:
                    ahead += a
                    back += b
            if ahead + back > best:
                best = ahead + back
                low, high = min(ahead, back) / max(count, 1), max(ahead, back) / max(count, 1)
            line = max(line, total * resolution)
    return low, high, line


@numba.njit(cache=True)
def flush_walls(frame, length, floor, resolution):  # type: ignore[no-untyped-def]
    """flush_low, flush_high, flush_line: walls that go on at right angles from the border's ends."""
    row, col, dr, dc = frame
    first, last = int(FLUSH_START / resolution), int(FLUSH_REACH / resolution)
    most = int(length / 2 + FLUSH / resolution) + 2
    share = np.zeros((2, 2))
    for side in range(2):
        sign = 1 - 2 * side
        for k in range(first, last):
            r, c = row - sign * k * dc, col + sign * k * dr
            if not value_at(floor, r, c):
                continue
            for end in range(2):
                way = 1 - 2 * end
                run = free_run(floor, r, c, way * dr, way * dc, most)
                if abs(run - length / 2) * resolution <= FLUSH:
                    share[side, end] += 1.0 / (last - first)
    sides = (share[0].sum() / 2, share[1].sum() / 2)
    line = max(min(share[0, 0], share[1, 0]), min(share[0, 1], share[1, 1]))
    return min(sides), max(sides), line
