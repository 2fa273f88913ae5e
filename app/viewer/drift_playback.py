"""The drift of the drive that one tab shows instead of the finished model."""

from __future__ import annotations

import asyncio

from app.viewer.drift_drawing import DriftDrawing, MapPixels
from app.viewer.floor_image import Picture
from app.viewer.messages import Drift, Pointed
from app.viewer.moment_scene import THEMES
from app.viewer.tab_scene import TabScene

NOTHING = Drift(type="drift", on=False, closure=None, places=())


class DriftPlayback:
    """Draws what was asked for last; it outlives a lost view. Event loop's thread only."""

    def __init__(self) -> None:
        self.wanted = NOTHING
        self._drawing: asyncio.Task[None] | None = None

    @property
    def shown(self) -> bool:
        """Whether the drift is shown instead of the model."""
        return self.wanted.on

    def show(self, wanted: Drift, scene: TabScene | None, theme: str) -> None:
        """Shows the drive somewhere between odometry and correction, or the model again."""
        self.wanted = wanted
        if scene is None:
            return
        if not wanted.on:
            self.stop()
            scene.drift.clear()
        elif self._drawing is None or self._drawing.done():
            self._drawing = asyncio.create_task(self._draw(scene, theme))

    def again(self, scene: TabScene, theme: str) -> None:
        """The same in a new view, in another theme or after the model was drawn anew."""
        self.stop()
        if self.wanted.on:
            self.show(self.wanted, scene, theme)

    def stop(self) -> None:
        """What is shown stays."""
        if self._drawing is not None:
            self._drawing.cancel()
            self._drawing = None

    def pointed(self, drift: DriftDrawing, point: tuple[float, float]) -> Pointed:
        """What a click on the floor means."""
        row, away = drift.nearest(point, self.wanted.share)
        return Pointed(point=point, t=float(drift.t[row]), away_m=away)

    async def _draw(self, scene: TabScene, theme: str) -> None:
        """Draws until nothing newer is wanted; what passes by meanwhile is left out."""
        done: Drift | None = None
        while self.wanted is not done and self.wanted.on:
            done = self.wanted
            drift = scene.drawing.drift
            if drift is None:
                return
            await asyncio.to_thread(_put, scene, drift, done, theme)


def _put(scene: TabScene, drift: DriftDrawing, wanted: Drift, theme: str) -> None:
    """Paints the pictures and draws: for a thread."""
    pictures: dict[str, tuple[Picture, MapPixels]] = {}
    for name, pixels, opacity in (
        ("corrected", drift.corrected_map, wanted.share),
        ("odometry", drift.odometry_map, 1 - wanted.share),
    ):
        if pixels is not None and opacity > 0:
            pictures[name] = (pixels.picture(THEMES[theme], opacity, name == "odometry"), pixels)
    scene.drift.show(scene.drawing, drift, wanted, pictures)
