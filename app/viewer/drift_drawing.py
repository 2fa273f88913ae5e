"""The drive of a model before and after its correction, as it is drawn; computed without viser."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from PIL import Image

from app.viewer.floor_image import FloorTheme, Picture
from core.geometry import FloatArray
from core.mapping.map_server import PIXEL_FREE, PIXEL_OCCUPIED, trinary
from core.mapping.occupancy_grid import GridGeometry
from core.topology import Model

ODOMETRY_OCCUPIED = (222, 96, 84)
"""Walls of the map at the odometry: they stand out against those of the corrected one."""


@dataclass(frozen=True)
class MapPixels:
    """A map as pixels (rows, cols) like those of map.pgm, row 0 = lowest y, and where it lies."""

    pixels: Picture
    geometry: GridGeometry

    def picture(self, theme: FloorTheme, opacity: float, odometry: bool) -> Picture:
        """RGBA in the colours of a theme; unknown cells are transparent."""
        rgba = np.zeros((*self.pixels.shape, 4), np.uint8)
        alpha = round(255 * opacity)
        wall = ODOMETRY_OCCUPIED if odometry else theme.occupied
        rgba[self.pixels == PIXEL_FREE] = (*theme.free, alpha)
        rgba[self.pixels == PIXEL_OCCUPIED] = (*wall, alpha)
        return rgba


@dataclass(frozen=True)
class ClosureMark:
    """A place found again: its ends as rows of the drive."""

    id: str
    source: int
    target: int
    accepted: bool


@dataclass(frozen=True)
class DriftDrawing:
    """What is shown of a drive.

    Attributes:
        t: (N,) seconds.
        corrected, odometry: (N, 3) poses of the map and as the odometry had them.
        closures: accepted or not.
        corrected_map, odometry_map: the latter is None where it was not kept.
    """

    t: FloatArray
    corrected: FloatArray
    odometry: FloatArray
    closures: tuple[ClosureMark, ...]
    corrected_map: MapPixels
    odometry_map: MapPixels | None

    def between(self, share: float) -> FloatArray:
        """(N, 2) the drive on its way from the odometry (0) to the corrected poses (1)."""
        before, after = self.odometry[:, :2], self.corrected[:, :2]
        return np.asarray(before + share * (after - before))

    def row_at(self, t: float) -> int:
        """The row nearest to a time."""
        return int(np.abs(self.t - t).argmin())

    def nearest(self, point: tuple[float, float], share: float) -> tuple[int, float]:
        """The row of the drive nearest to a world point, and how far away it is (m)."""
        away = np.hypot(*(self.between(share) - np.array(point)).T)
        row = int(away.argmin())
        return row, float(away[row])


def draw_drift(model: Model) -> DriftDrawing | None:
    """The drawing of a model's drive; None where nothing was kept of it."""
    view = model.drift
    if view is None or len(view.report["trajectory"]) < 2:
        return None
    rows = np.array(view.report["trajectory"], float)
    before = view.report["odometry_map"]
    picture = view.odometry_map
    t = rows[:, 0]
    return DriftDrawing(
        t,
        rows[:, 1:4],
        rows[:, 4:7],
        tuple(
            ClosureMark(
                str(closure["id"]),
                int(np.abs(t - closure["t_source"]).argmin()),
                int(np.abs(t - closure["t_target"]).argmin()),
                bool(closure["accepted"]),
            )
            for closure in model.provenance.get("odometry", {}).get("closures", ())
        ),
        MapPixels(trinary(model.grid)[::-1], model.grid.geometry),
        None if before is None or picture is None else _read_map(picture, before),
    )


def _read_map(png: bytes, place: Mapping[str, Any]) -> MapPixels:
    with Image.open(io.BytesIO(png)) as image:
        pixels = np.asarray(image.convert("L"), np.uint8)[::-1]
    x, y, heading = (float(value) for value in place["origin"])
    rows, cols = pixels.shape
    return MapPixels(
        pixels, GridGeometry(float(place["resolution"]), (x, y, heading), (rows, cols))
    )
