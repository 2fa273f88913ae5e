"""Lines in which walls would go on across free space: where an open doorway would be closed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np
from skimage.measure import approximate_polygon, find_contours

from core.geometry import BoolArray, FloatArray


@dataclass(frozen=True)
class ExtensionConfig:
    """All in metres.

    Attributes:
        tolerance: a wall may wave by this much and is still straight.
        shortest_wall: straight pieces that are shorter have no direction to go on in.
        shortest, longest: length of an extension; narrower gaps let nobody through, wider ones no
            longer look like an opening between two rooms.
        start: how far from the corner an extension must have reached free space.
        same: extensions whose ends lie so close together are one.
    """

    tolerance: float = 0.1
    shortest_wall: float = 0.6
    shortest: float = 0.4
    longest: float = 4.0
    start: float = 0.2
    same: float = 0.15


def wall_extensions(
    floor: BoolArray, resolution: float, config: ExtensionConfig | None = None
) -> FloatArray:
    """Segments across the floor, each the straight continuation of a piece of its outline.

    Args:
        floor: (rows, cols) free space.
        resolution: metres per cell.
        config: parameters.

    Returns:
        (n, 2, 2) both ends `[row, col]`, the shortest first.
    """
    config = config or ExtensionConfig()
    most = int((config.longest + config.start) / resolution) + 1
    start = int(config.start / resolution)
    found = []
    for contour in find_contours(np.pad(floor, 1).astype(float), 0.5):  # type: ignore[no-untyped-call]
        corners = approximate_polygon(contour - 1, config.tolerance / resolution)  # type: ignore[no-untyped-call]
        walls = np.diff(corners, axis=0)
        length = np.hypot(walls[:, 0], walls[:, 1])
        for i in np.flatnonzero(length * resolution >= config.shortest_wall):
            direction = walls[i] / length[i]
            for corner, onward in ((corners[i + 1], direction), (corners[i], -direction)):
                first, run = _onward(floor, corner, onward, most, start)
                if config.shortest <= run * resolution <= config.longest:
                    ends = np.array([[first], [first + run - 1]])
                    found.append(corner + ends * onward)
    return _distinct(found, config.same / resolution)


@numba.njit(cache=True)
def _onward(floor, corner, direction, most, start):  # type: ignore[no-untyped-def]
    """The step (of length 1) from a corner at which free space begins, and how many steps it lasts.

    (0, 0) where it begins later than `start` steps after the first, or does not end within `most`.
    """
    first = 0
    for step in range(1, most + 1):
        i = int(round(corner[0] + step * direction[0]))
        j = int(round(corner[1] + step * direction[1]))
        free = 0 <= i < floor.shape[0] and 0 <= j < floor.shape[1] and floor[i, j]
        if free and not first:
            first = step
        if first and not free:
            return first, step - first
        if not first and step > start:
            break
    return 0, 0


def _distinct(segments: list[FloatArray], same: float) -> FloatArray:
    """The segments without those that nearly repeat a shorter one."""
    if not segments:
        return np.zeros((0, 2, 2))
    stack = np.stack(segments)
    span = stack[:, 1] - stack[:, 0]
    stack = stack[np.argsort(np.hypot(span[:, 0], span[:, 1]), kind="stable")]
    return np.asarray(stack[_first_of_each(stack, same)])


@numba.njit(cache=True)
def _first_of_each(stack, same):  # type: ignore[no-untyped-def]
    """Which segments lie no nearer than `same`, either way round, to an earlier one of them."""
    kept = np.ones(len(stack), np.bool_)
    middle = (stack[:, 0] + stack[:, 1]) / 2
    reach = same + 1
    for i in range(len(stack)):
        for j in range(i):
            if not kept[j] or abs(middle[i, 0] - middle[j, 0]) > reach:
                continue
            if _near(stack[j], stack[i], 0, same) or _near(stack[j], stack[i], 1, same):
                kept[i] = False
                break
    return kept


@numba.njit(cache=True)
def _near(one, other, turned, same):  # type: ignore[no-untyped-def]
    """Whether both ends of two segments, the other one turned or not, lie closer than `same`."""
    for end in range(2):
        row, col = one[end] - other[end ^ turned]
        if abs(row) >= same or math.hypot(row, col) >= same:
            return False
    return True
