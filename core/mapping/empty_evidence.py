"""Which readings call a cell empty: how loudly, and how many of them. One echo may be false, two
seldom agree on an error."""

from __future__ import annotations

import numba
import numpy as np

from core.mapping.beam_footprint import cells_of_beam


@numba.njit(cache=True)
def empty_evidence(alive, clearance, pose, ranges, sonar, half, gain, frame, shape, capacity):  # type: ignore[no-untyped-def]
    """Maximum pressure and number (both flat) of the living readings (M,) that call each cell empty.

    A reading speaks of the cells of its sector up to `clearance` metres before its echo; the other
    arguments are those of `cells_of_beam`, by reading and by sonar.
    """
    loudest = np.zeros(shape[0] * shape[1])
    count = np.zeros(shape[0] * shape[1], np.int64)
    cells = np.empty(capacity, np.int64)
    distance, pressure = np.empty(capacity), np.empty(capacity)
    for i in range(len(ranges)):
        reach = ranges[i] - clearance
        if not alive[i] or reach <= 0:
            continue
        s = sonar[i]
        n = cells_of_beam(pose[i], reach, half[s], gain[s], frame, shape, cells, distance, pressure)
        for k in range(n):
            count[cells[k]] += 1
            loudest[cells[k]] = max(loudest[cells[k]], pressure[k])
    return loudest, count
