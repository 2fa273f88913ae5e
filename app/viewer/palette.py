"""Colours of the regions: soft, told apart by colour-blind eyes, and never alike side by side."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from core.geometry import FloatArray, IntArray
from core.topology import TopologicalMap

Colour = tuple[int, int, int]

PALETTE: tuple[Colour, ...] = (
    (78, 132, 216),  # blue
    (236, 158, 66),  # orange
    (64, 168, 132),  # green
    (190, 112, 196),  # orchid
    (226, 200, 76),  # yellow
    (92, 188, 222),  # sky
    (222, 104, 98),  # vermilion
    (136, 122, 214),  # violet
    (158, 184, 84),  # olive
    (228, 138, 172),  # rose
    (54, 140, 158),  # teal
    (178, 136, 104),  # clay
)
"""Hues after Okabe and Ito (2008), softened to one lightness band and extended to twelve."""

_DEUTERANOPIA = np.array([[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]])
_PROTANOPIA = np.array([[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]])
"""Linear-RGB simulations of Machado et al. (2009), severity 1."""

_NEIGHBOUR_WEIGHT = 4.0
"""How much more a likeness to a neighbouring room counts than one to a room further off."""
_ALIKE = 100.0
"""Cost of giving one hue twice: only when all are taken, and never to neighbours while avoidable."""
_WALL_CELLS = 8
"""Grids between two rooms with only a wall between them."""
_SHADE_STEP = 0.10
_MAX_SHADE = 0.3


def node_colours(
    topology: TopologicalMap, regions: IntArray, earlier: Mapping[str, Colour] | None = None
) -> dict[str, Colour]:
    """A colour for every node id, unlike its neighbours'; a hue that is used again is shaded.

    Neighbours are nodes that a doorway joins or that only a wall divides. Depends on the regions
    (rows, cols) and edges only, so that naming nodes never recolours anything; a node keeps the hue
    that it had `earlier`, so that an edit recolours nothing else.
    """
    nodes = sorted(topology.nodes, key=lambda node: node.region)
    id_of = {node.region: node.id for node in nodes}
    pairs = [(edge.source, edge.target) for edge in topology.edges]
    pairs += [(id_of[a], id_of[b]) for a, b in _beside(regions) if a in id_of and b in id_of]
    before = {key: _nearest_hue(colour) for key, colour in (earlier or {}).items()}
    hues = _hues([node.id for node in nodes], pairs, before)
    colours: dict[str, Colour] = {}
    times: dict[int, int] = {}
    for node in nodes:
        hue = hues[node.id]
        colours[node.id] = _shade(PALETTE[hue], times.get(hue, 0))
        times[hue] = times.get(hue, 0) + 1
    return colours


def hex_of(colour: Colour) -> str:
    """`#rrggbb` of a colour."""
    return "#{:02x}{:02x}{:02x}".format(*colour)


def linear(colours: Sequence[Colour] | FloatArray) -> FloatArray:
    """sRGB (N, 3) in 0..255 -> linear RGB in 0..255, which viser's `batched_colors` are."""
    srgb = np.asarray(colours, float) / 255
    return np.asarray(
        np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4) * 255, float
    )


def mix(colour: Colour, other: Colour, share: float) -> Colour:
    """`colour` with a `share` (0..1) of `other`."""
    a, b = np.array(colour, float), np.array(other, float)
    r, g, bl = np.rint(a + (b - a) * share).astype(int).tolist()
    return (r, g, bl)


def _beside(regions: IntArray) -> set[tuple[int, int]]:
    """Pairs of regions that come as close as the thickness of a wall."""
    pairs: set[tuple[int, int]] = set()
    for reach in range(1, _WALL_CELLS + 1):
        for a, b in (
            (regions[reach:], regions[:-reach]),
            (regions[:, reach:], regions[:, :-reach]),
        ):
            near = (a != b) & (a > 0) & (b > 0)
            pairs |= set(zip(a[near].tolist(), b[near].tolist(), strict=True))
    return pairs


def _nearest_hue(colour: Colour) -> int:
    """Index into PALETTE of the hue that a colour is a shade of."""
    return int(np.argmin(np.abs(np.subtract(PALETTE, colour)).sum(axis=1)))


def _hues(
    keys: Sequence[str], pairs: Iterable[tuple[str, str]], before: Mapping[str, int]
) -> Mapping[str, int]:
    """Index into PALETTE of each key: greedy, the most constrained first, far from its neighbours.

    Keys with a hue from before are served first and keep it, unless a neighbour has it already.
    """
    neighbours: dict[str, set[str]] = {key: set() for key in keys}
    for a, b in pairs:
        if a != b and a in neighbours and b in neighbours:
            neighbours[a].add(b)
            neighbours[b].add(a)
    likeness = 1.0 / (1.0 + _distances() / 12.0)
    order = sorted(
        keys, key=lambda key: (key not in before, -len(neighbours[key]), keys.index(key))
    )
    chosen: dict[str, int] = {}
    for key in order:
        if key in before and before[key] not in {chosen.get(other) for other in neighbours[key]}:
            chosen[key] = before[key]
            continue
        cost = np.zeros(len(PALETTE))
        for other, hue in chosen.items():
            weight = _NEIGHBOUR_WEIGHT if other in neighbours[key] else 1.0
            cost += weight * likeness[hue]
            cost[hue] += _ALIKE * weight
        chosen[key] = int(np.argmin(cost))
    return chosen


def _distances() -> FloatArray:
    """(12, 12) smallest distance of two hues, over normal and colour-blind sight, in CIELAB."""
    base = linear(PALETTE) / 255
    views = [base] + [np.clip(base @ matrix.T, 0, 1) for matrix in (_DEUTERANOPIA, _PROTANOPIA)]
    labs = [_lab(view) for view in views]
    return np.asarray(
        np.min([np.linalg.norm(lab[:, None] - lab[None], axis=-1) for lab in labs], axis=0)
    )


def _lab(rgb: FloatArray) -> FloatArray:
    """Linear RGB (N, 3) in 0..1 -> CIELAB (D65)."""
    to_xyz = np.array(
        [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    )
    xyz = rgb @ to_xyz.T / np.array([0.9505, 1.0, 1.089])
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.stack(
        (116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])), axis=-1
    )


def _shade(colour: Colour, index: int) -> Colour:
    """The index-th shade of a hue: lighter and darker in turn."""
    if index == 0:
        return colour
    amount = min(_SHADE_STEP * ((index + 1) // 2), _MAX_SHADE)
    return mix(colour, (255, 255, 255) if index % 2 else (40, 44, 60), amount)
