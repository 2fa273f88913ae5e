"""A sentence that says why the robot is believed to be where it is."""

from __future__ import annotations

import numpy as np

from core.geometry import FloatArray

SURE = 0.9
"""Probability from which on a node is called by its name without an alternative."""
WORTH_NAMING = 0.05
"""Probability from which on an alternative is named."""
MOSTLY = 0.5


def explain(
    names: tuple[str, ...],
    probabilities: FloatArray,
    unknown: float,
    fits: FloatArray,
    distance: float,
) -> str:
    """Why the probabilities are as they are.

    Args:
        names: what people call the nodes.
        probabilities: (n,) of the nodes.
        unknown: probability of being outside the map.
        fits: (n,) share of the echoes that the best place of each node explains.
        distance: metres driven since the last step.
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
    others = [names[int(i)] for i in order[1:3] if probabilities[int(i)] > WORTH_NAMING]
    if unknown > WORTH_NAMING:
        others.append("a place outside the map")
    doubt = f"; it could also be {' or '.join(others)}" if others else ""
    return f"{moved}; {told}{doubt}"
