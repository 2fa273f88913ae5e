"""Where the camera stands so that a home fills the picture. viser only has perspective cameras."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.geometry import FloatArray

_SAME_PLACE = 0.01
"""Share of the distance that two cameras may be apart and still look the same."""


@dataclass(frozen=True)
class CameraConfig:
    """Angles in radians."""

    fov_3d: float = np.deg2rad(40.0)
    elevation: float = np.deg2rad(57.0)
    azimuth: float = np.deg2rad(-90.0)
    """Seen from the south, so that x runs to the right as in the top view."""
    fov_top: float = np.deg2rad(6.0)
    """From far away and narrow: looks orthographic."""
    fill: float = 0.94
    """Share of the picture that the home takes."""
    headroom: float = 1.5
    """Metres above the floor that must be in the picture, labels included."""


@dataclass(frozen=True)
class View:
    """A camera: position, the point it looks at and its up, vertical field of view in radians."""

    position: tuple[float, float, float]
    look_at: tuple[float, float, float]
    up: tuple[float, float, float]
    fov: float


def fit_3d(outline: FloatArray, aspect: float, config: CameraConfig | None = None) -> View:
    """The view from above and the side that shows everything within `outline` (K, 2)."""
    config = config or CameraConfig()
    towards = -np.array(
        [
            np.cos(config.elevation) * np.cos(config.azimuth),
            np.cos(config.elevation) * np.sin(config.azimuth),
            np.sin(config.elevation),
        ]
    )
    return _fit(
        _corners(outline, (0.0, config.headroom)),
        towards,
        np.array([0, 0, 1.0]),
        config.fov_3d,
        aspect,
        config.fill,
    )


def fit_top(outline: FloatArray, aspect: float, config: CameraConfig | None = None) -> View:
    """The view straight down, +y up."""
    config = config or CameraConfig()
    down = np.array([0.0, 1e-4, -1.0])
    return _fit(
        _corners(outline, (0.0,)),
        down / np.linalg.norm(down),
        np.array([0, 0, 1.0]),
        config.fov_top,
        aspect,
        config.fill,
    )


def farthest(view: View, outline: FloatArray) -> float:
    """A far plane and zoom-out limit (m) that never clips the home seen from `view`."""
    distance = float(np.linalg.norm(np.subtract(view.position, view.look_at)))
    return 6.0 * distance + 4.0 * float(np.ptp(outline, axis=0).max())


def blend(a: View, b: View, share: float) -> View:
    """The camera on its way from a to b, eased; the home keeps its size when the lens changes."""
    s = share * share * (3 - 2 * share)
    look = _lerp(a.look_at, b.look_at, s)
    heights = [
        np.linalg.norm(np.subtract(view.position, view.look_at)) * np.tan(view.fov / 2)
        for view in (a, b)
    ]
    fov = float(np.exp(np.log(a.fov) + s * (np.log(b.fov) - np.log(a.fov))))
    distance = float((heights[0] + s * (heights[1] - heights[0])) / np.tan(fov / 2))
    directions = [
        np.subtract(view.position, view.look_at)
        / max(float(np.linalg.norm(np.subtract(view.position, view.look_at))), 1e-9)
        for view in (a, b)
    ]
    direction = directions[0] + s * (directions[1] - directions[0])
    direction /= max(float(np.linalg.norm(direction)), 1e-9)
    return View(_triple(np.array(look) + distance * direction), look, _lerp(a.up, b.up, s), fov)


def _fit(
    corners: FloatArray, towards: FloatArray, up: FloatArray, fov: float, aspect: float, fill: float
) -> View:
    right = np.cross(towards, up)
    right /= np.linalg.norm(right)
    upward = np.cross(right, towards)
    half_height = np.tan(fov / 2) * fill
    half_width = half_height * max(aspect, 0.2)
    centre = (corners.min(axis=0) + corners.max(axis=0)) / 2
    for _ in range(4):
        offset = corners - centre
        x, y, depth = offset @ right, offset @ upward, offset @ towards
        distance = float(
            max(
                (np.abs(x) / half_width - depth).max(),
                (np.abs(y) / half_height - depth).max(),
                0.5,
            )
        )
        u, v = x / (distance + depth), y / (distance + depth)
        middle = (u.max() + u.min()) / 2 * right + (v.max() + v.min()) / 2 * upward
        centre = centre + middle * distance
    return View(_triple(centre - towards * distance), _triple(centre), _triple(up), fov)


def _corners(outline: FloatArray, heights: tuple[float, ...]) -> FloatArray:
    """(K * heights, 3): the outline at each of the heights."""
    return np.concatenate(
        [np.column_stack((outline, np.full(len(outline), height))) for height in heights]
    )


def _lerp(
    a: tuple[float, float, float], b: tuple[float, float, float], share: float
) -> tuple[float, float, float]:
    return _triple(np.array(a) + share * (np.array(b) - np.array(a)))


def _triple(values: FloatArray) -> tuple[float, float, float]:
    x, y, z = np.asarray(values, float).tolist()
    return (x, y, z)


def near(a: View, b: View) -> bool:
    """Whether two cameras are the same for the eye."""
    distance = float(np.linalg.norm(np.subtract(b.position, b.look_at)))
    off = np.linalg.norm(np.subtract(a.position, b.position)) + np.linalg.norm(
        np.subtract(a.look_at, b.look_at)
    )
    return bool(off < _SAME_PLACE * distance)
