"""The moment of the drive that one tab shows instead of the finished model."""

from __future__ import annotations

import asyncio
import logging

from app.viewer.layers import CELLS, GRAPH, GRID, LABELS, PATH, REGIONS, WALLS
from app.viewer.messages import Moment
from app.viewer.moment_scene import MomentDrawing, draw_moment
from app.viewer.tab_scene import TabScene
from core.errors import ModelError

logger = logging.getLogger(__name__)
FINISHED = (GRID, REGIONS, WALLS, CELLS, GRAPH, LABELS, PATH)
"""Layers of the finished model, which did not exist at the moment that is shown."""


class MomentPlayback:
    """Draws the moment asked for last; it outlives a lost view. Event loop's thread only."""

    def __init__(self) -> None:
        self.wanted: Moment | None = None
        self._drawing: asyncio.Task[None] | None = None

    @property
    def shown(self) -> bool:
        """Whether a moment is shown instead of the model."""
        return self.wanted is not None and self.wanted.step is not None

    def show(self, wanted: Moment, scene: TabScene | None, theme: str) -> None:
        """Shows a step of the drive, or the model again when its step is null."""
        self.wanted = wanted
        if scene is None:
            return
        if not self.shown:
            self.stop()
            scene.moment.clear()
            scene.belief.show_robot(scene.drawing, None)
        elif self._drawing is None or self._drawing.done():
            self._drawing = asyncio.create_task(self._draw(scene, theme))

    def again(self, scene: TabScene, theme: str) -> None:
        """The same in a new view, in another theme or after the model was drawn anew."""
        self.stop()
        if self.wanted is not None:
            self.show(self.wanted, scene, theme)

    def stop(self) -> None:
        """What is shown stays."""
        if self._drawing is not None:
            self._drawing.cancel()
            self._drawing = None

    async def _draw(self, scene: TabScene, theme: str) -> None:
        """Draws until nothing newer is wanted; moments that pass by meanwhile are left out."""
        done: Moment | None = None
        while self.wanted is not done and self.wanted is not None:
            done = self.wanted
            if done.step is None or done.step >= len(scene.drawing.moments):
                return
            try:
                moment = await asyncio.to_thread(
                    draw_moment, scene.drawing, done.step, done.decision, theme
                )
            except ModelError as error:
                logger.warning("step %d of the drive cannot be shown: %s", done.step, error)
                return
            await asyncio.to_thread(self._put, scene, moment)

    def _put(self, scene: TabScene, moment: MomentDrawing) -> None:
        scene.moment.show(scene.drawing, moment)
        scene.belief.show_robot(scene.drawing, moment.pose)
