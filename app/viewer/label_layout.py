"""Which labels are shown, so that none covers another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.viewer.camera import View
from core.geometry import FloatArray

_EM_PIXELS = 12.0
"""viser's labels have 12 CSS pixels per em at scale 1, whatever the camera."""
_CHARACTER_WIDTH, _LINE_HEIGHT, _GAP = 0.56, 1.6, 0.15
"""In em: a mean character, a label with its padding, and the air between two labels."""


@dataclass(frozen=True)
class LabelBox:
    """A label to place: its world anchor (middle of its lower edge) and how much it matters."""

    text: str
    anchor: tuple[float, float, float]
    weight: float


def project(view: View, points: FloatArray) -> FloatArray:
    """World points (N, 3) -> (N, 3): x and y in picture heights, +y up, 0 in the middle; and depth."""
    towards = np.subtract(view.look_at, view.position)
    towards = towards / np.linalg.norm(towards)
    right = np.cross(towards, view.up)
    right /= np.linalg.norm(right)
    upward = np.cross(right, towards)
    offset = points - np.array(view.position)
    depth = offset @ towards
    safe = np.where(depth > 1e-6, depth, np.inf) * 2 * np.tan(view.fov / 2)
    return np.column_stack((offset @ right / safe, offset @ upward / safe, depth))


def visible_labels(
    labels: Sequence[LabelBox], view: View, picture_height: float, scale: float
) -> list[bool]:
    """Greedy by weight: a label is hidden when it would cover one that matters more.

    Args:
        picture_height: of the 3D view, in CSS pixels.
        scale: viser's `font_screen_scale`.
    """
    if not labels:
        return []
    flat = project(view, np.array([label.anchor for label in labels]))
    em = scale * _EM_PIXELS / max(picture_height, 1.0)
    half = (
        np.array([(len(label.text) * _CHARACTER_WIDTH + 0.6) / 2 + _GAP for label in labels]) * em
    )
    tall = (_LINE_HEIGHT + _GAP) * em
    shown = [False] * len(labels)
    placed: list[tuple[float, float, float]] = []
    for index in sorted(range(len(labels)), key=lambda i: (-labels[i].weight, i)):
        x, y, depth = flat[index].tolist()
        if depth <= 0:
            continue
        if all(
            abs(x - ox) >= half[index] + ohalf or abs(y - oy) >= tall for ox, oy, ohalf in placed
        ):
            shown[index] = True
            placed.append((x, y, float(half[index])))
    return shown
