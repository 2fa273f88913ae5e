"""Lines in which walls would go on across free space: where an open doorway would be closed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np
from skimage.measure import find_contours

from core.geometry import BoolArray, FloatArray
from core.segmentation.simplified_line import simplified_line


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
    found = []
    for contour in find_contours(np.pad(floor, 1).astype(float), 0.5):  # type: ignore[no-untyped-call]
        corners = simplified_line(contour - 1, config.tolerance / resolution)
        walls = np.diff(corners, axis=0)
        length = np.hypot(walls[:, 0], walls[:, 1])
        for i in np.flatnonzero(length * resolution >= config.shortest_wall):
            direction = walls[i] / length[i]
            for corner, onward in ((corners[i + 1], direction), (corners[i], -direction)):
                segment = _onward(floor, corner, onward, resolution, config)
                if segment is not None:
                    found.append(segment)
    return _distinct(found, config.same / resolution)


def _onward(
    floor: BoolArray,
    corner: FloatArray,
    direction: FloatArray,
    resolution: float,
    config: ExtensionConfig,
) -> FloatArray | None:
    """The free stretch beyond a corner, or None when there is none of a fitting length."""
    steps = np.arange(1, int((config.longest + config.start) / resolution) + 2)
    cells = np.rint(corner + steps[:, None] * direction).astype(np.int64)
    inside = ((cells >= 0) & (cells < floor.shape)).all(axis=1)
    free = np.zeros(len(steps), bool)
    free[inside] = floor[cells[inside, 0], cells[inside, 1]]
    if not free[: int(config.start / resolution) + 1].any():
        return None
    first = int(free.argmax())
    run = int((~free[first:]).argmax())
    if not config.shortest <= run * resolution <= config.longest:
        return None
    return np.stack(
        (corner + steps[first] * direction, corner + steps[first + run - 1] * direction)
    )


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
