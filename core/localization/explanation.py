"""A sentence that says why the robot is believed to be where it is."""

from __future__ import annotations

import numpy as np

from core.geometry import FloatArray

SURE = 0.9
"""Probability from which on a node is called by its name without an alternative."""
WORTH_NAMING = 0.05
"""Probability from which on an alternative is named."""
MOSTLY = 0.5
ALIKE = 0.1
"""Two places fit alike when they explain shares of the echoes that differ by less,"""
APART = 1.0
"""and look the same when they are not two sides of one border but this far apart (m)."""


def explain(
    names: tuple[str, ...],
    probabilities: FloatArray,
    unknown: float,
    fits: FloatArray,
    distance: float,
    poses: FloatArray,
) -> str:
    """Why the probabilities are as they are.

    Args:
        names: what people call the nodes.
        probabilities: (n,) of the nodes.
        unknown: probability of being outside the map.
        fits: (n,) share of the echoes that the best place of each node explains.
        distance: metres driven since the last step.
        poses: (n, 3) the best place of each node, NaN where it has none.
    """
    moved = f"moved {distance:.1f} m"
    order = np.argsort(-probabilities)
    best = int(order[0])
    told = f"the echoes fit {names[best]} at {fits[best]:.2f}"
    if len(order) > 1:
        second = int(order[1])
        told += f", {names[second]} at {fits[second]:.2f}"
    if unknown > MOSTLY:
        return f"{moved}; nowhere on the map fits well enough ({told})"
    if probabilities[best] >= SURE:
        return f"{moved}; {told}"
    rivals = [int(i) for i in order[1:4] if probabilities[int(i)] > WORTH_NAMING]
    twins = [i for i in rivals if _look_the_same(fits[[best, i]], poses[[best, i]])]
    others = [names[i] for i in rivals if i not in twins]
    if unknown > WORTH_NAMING:
        others.append("a place outside the map")
    same = f"; {names[best]} looks the same as {_listed(twins, names)}" if twins else ""
    doubt = f"; it could also be {' or '.join(others)}" if others else ""
    return f"{moved}; {told}{same}{doubt}"


def _look_the_same(fits: FloatArray, poses: FloatArray) -> bool:
    """Whether two places, given by fits (2,) and poses (2, 3), explain the readings alike."""
    apart = float(np.hypot(*(poses[0, :2] - poses[1, :2])))
    return abs(float(fits[0] - fits[1])) < ALIKE and apart > APART


def _listed(nodes: list[int], names: tuple[str, ...]) -> str:
    return " and ".join(names[i] for i in nodes)
