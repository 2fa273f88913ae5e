"""The belief that one tab shows: set step by step, with bars that grow instead of jumping."""

from __future__ import annotations

import asyncio

import numpy as np

from app.viewer.belief_shapes import BarPlan, plan_bars, with_unknown
from app.viewer.drawing import Drawing
from app.viewer.messages import Belief
from app.viewer.tab_scene import TabScene
from core.geometry import FloatArray

_GROW_TIME, _GROW_STEPS = 0.24, 6
"""Seconds and pictures of a bar's way from one step to the next."""


class Playback:
    """What is shown of a localization in a tab; it outlives a lost view. Event loop's thread only."""

    def __init__(self) -> None:
        self.belief: Belief | None = None
        self._bars: BarPlan | None = None
        self._growing: asyncio.Task[None] | None = None

    def show(self, belief: Belief | None, scene: TabScene | None) -> None:
        """The belief of another step, or none any more."""
        self.stop()
        before, self.belief = self._bars, belief
        if scene is None:
            self._bars = None
        elif belief is None:
            self._bars = None
            scene.belief.clear()
        else:
            self._marks(belief, scene)
            plan = plan_bars(scene.drawing, belief.probabilities, belief.unknown)
            if before is None or before.scales.shape != plan.scales.shape:
                self._draw(plan, scene)
            else:
                self._growing = asyncio.create_task(self._grow(before, plan, scene))

    def again(self, scene: TabScene, other_nodes: bool = True) -> None:
        """The same in a new view, or after the model was drawn anew."""
        self.stop()
        if other_nodes:
            self._bars = None
            scene.belief.clear_nodes()
        if self.belief is not None:
            self.show(self.belief, scene)

    def stop(self) -> None:
        """Bars stay where they are."""
        if self._growing is not None:
            self._growing.cancel()
            self._growing = None

    def outline(self, drawing: Drawing) -> FloatArray:
        """(K, 2) what the camera has to show: the home, and the bar of `unknown` when there is one."""
        return drawing.outline if self.belief is None else with_unknown(drawing)

    def _marks(self, belief: Belief, scene: TabScene) -> None:
        drawing = scene.drawing
        scene.belief.show_robot(drawing, belief.pose)
        scene.belief.show_template(drawing, in_world(belief))
        scene.belief.show_candidates(drawing, belief.candidates)

    async def _grow(self, before: BarPlan, plan: BarPlan, scene: TabScene) -> None:
        for step in range(1, _GROW_STEPS + 1):
            self._draw(plan.on_the_way_from(before, step / _GROW_STEPS), scene)
            await asyncio.sleep(_GROW_TIME / _GROW_STEPS)

    def _draw(self, plan: BarPlan, scene: TabScene) -> None:
        self._bars = plan
        scene.belief.show_bars(scene.drawing, plan)


def in_world(belief: Belief) -> FloatArray:
    """(K, 2) the template, laid onto the map at the best pose."""
    points = np.array(belief.template, float).reshape(-1, 2)
    x, y, heading = belief.pose
    cos, sin = np.cos(heading), np.sin(heading)
    return np.asarray(points @ np.array([[cos, sin], [-sin, cos]]) + (x, y), float)
