"""A tab's camera: in a standard view that shows everything, on its way there, or where a person put it."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import viser

from app.viewer.camera import View, blend, farthest, fit_3d, fit_top, near
from app.viewer.tab_scene import TabScene
from core.geometry import FloatArray

_SETTLE_AFTER = 0.12
_SAME_ASPECT = 0.01
_TRAVEL_TIME, _TRAVEL_STEPS = 0.35, 12
"""Seconds and pictures of a camera's way from one standard view to another."""
_STILL_TELLS = 1.5
"""Seconds for which a slow browser may still tell where its camera was on the way."""


@dataclass(frozen=True)
class Fitted:
    """A standard view that the camera was sent to, and the aspect of the picture that it fits."""

    view: View
    aspect: float


class TabCamera:
    """Event loop's thread only.

    Attributes:
        standard: the standard view that was chosen last, "3d" or "top".
        kept: where a person has put the camera; None while it is in the standard view.
        first: where a browser looks until it is told; it may take that view after it was told.
    """

    def __init__(
        self,
        outline: Callable[[TabScene], FloatArray],
        aspect: Callable[[TabScene], float],
        settled: Callable[[View], None],
    ) -> None:
        """`outline` gives (K, 2) what must be in the picture, `aspect` that picture's width over its
        height; `settled` hears where the camera stands."""
        self.standard = "3d"
        self.kept: View | None = None
        self.first: View | None = None
        self._outline = outline
        self._aspect = aspect
        self._settled = settled
        self._fitted: Fitted | None = None
        self._aim: Fitted | None = None
        self._sent_at = -np.inf
        self._travel: asyncio.Task[None] | None = None
        self._settle_due: asyncio.TimerHandle | None = None

    def join(self, scene: TabScene) -> None:
        """A 3D view has connected: it looks from where the last one did."""
        self.stop()
        if self.kept is None:
            self._stand_at_standard(scene)
        else:
            scene.stand_at(self.kept, self._far(scene))
        self.moved(scene)

    def go(self, scene: TabScene | None, standard: str | None = None) -> None:
        """Goes to a standard view; by default to the last one, of what there is now."""
        self.standard = standard or self.standard
        self.kept = None
        if scene is not None:
            self.stop()
            self._fitted = None
            self._travel = asyncio.create_task(self._travel_to_standard(scene))

    def fit_again(self, scene: TabScene) -> None:
        """There is more to be seen: a camera that showed everything still does."""
        if self.kept is None and (self._aim is None or not near(self._aim.view, self._fit(scene))):
            self.go(scene)

    def follow(self, scene: TabScene, target: View) -> None:
        """Stands somewhere for now, as a person would have put it."""
        self.stop()
        self._fitted = self._aim = None
        self.kept = target
        scene.stand_at(target, self._far(scene))

    def moved(self, scene: TabScene) -> None:
        """The camera or the picture has changed: looked at again soon, not too often."""
        if self._settle_due is None:
            loop = asyncio.get_running_loop()
            self._settle_due = loop.call_later(_SETTLE_AFTER, self._settle, scene)

    def stop(self) -> None:
        """It stays where it is."""
        if self._travel is not None:
            self._travel.cancel()
            self._travel = None
        if self._settle_due is not None:
            self._settle_due.cancel()
            self._settle_due = None

    async def _travel_to_standard(self, scene: TabScene) -> None:
        start, target = camera_view(scene.client), self._fit(scene)
        self._sent_at = time.monotonic()
        for step in range(1, _TRAVEL_STEPS):
            scene.stand_at(blend(start, target, step / _TRAVEL_STEPS), self._far(scene))
            await asyncio.sleep(_TRAVEL_TIME / _TRAVEL_STEPS)
        self._stand_at_standard(scene)
        self.moved(scene)

    def _stand_at_standard(self, scene: TabScene) -> None:
        self._fitted = self._aim = Fitted(self._fit(scene), self._aspect(scene))
        self._sent_at = time.monotonic()
        scene.stand_at(self._fitted.view, self._far(scene))

    def _fit(self, scene: TabScene) -> View:
        fit = fit_top if self.standard == "top" else fit_3d
        return fit(self._outline(scene), self._aspect(scene))

    def _far(self, scene: TabScene) -> float:
        return farthest(self._fit(scene), scene.drawing.outline)

    def _settle(self, scene: TabScene) -> None:
        """After the camera or the picture's size has changed: fits again, tells where it stands."""
        self._settle_due = None
        view = camera_view(scene.client)
        if self._is_at_first(view):
            view = self._send_again(scene)
        if self._aim is not None and self._is_on_its_way(view):
            self._fitted = self._aim
            self.kept = None
            if abs(self._aspect(scene) / self._aim.aspect - 1) > _SAME_ASPECT:
                self._stand_at_standard(scene)
                view = camera_view(scene.client)
        else:
            self._fitted = None
            self.kept = view
        self._settled(view)

    def _is_at_first(self, view: View) -> bool:
        return self.first is not None and near(view, self.first)

    def _send_again(self, scene: TabScene) -> View:
        """Sends a browser that has just taken its own first view where it was to look; that view."""
        if self.kept is None or self._is_at_first(self.kept):
            self.kept = None
            self._stand_at_standard(scene)
        else:
            scene.stand_at(self.kept, self._far(scene))
        return camera_view(scene.client)

    def _is_on_its_way(self, view: View) -> bool:
        """Whether the camera is where it was sent, or was sent there only just now."""
        assert self._aim is not None
        return near(view, self._aim.view) or time.monotonic() - self._sent_at < _STILL_TELLS


def camera_view(client: viser.ClientHandle) -> View:
    """Where a client's camera is now."""
    camera = client.camera
    position, look_at, up = (
        tuple(float(v) for v in vector)
        for vector in (camera.position, camera.look_at, camera.up_direction)
    )
    return View(position, look_at, up, float(camera.fov))  # type: ignore[arg-type]
