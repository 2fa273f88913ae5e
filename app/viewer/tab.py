"""One tab: its page's event socket, its browser's 3D view, and what both agreed on."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import viser

from app.viewer.camera import View, blend, farthest, fit_3d, fit_top, near
from app.viewer.camera_link import CameraLink
from app.viewer.drawing import Drawing, NodeMark
from app.viewer.layers import DEFAULT_LAYERS
from app.viewer.mailbox import Mailbox
from app.viewer.messages import (
    Camera,
    CameraView,
    FromPage,
    Layers,
    Measure,
    Measured,
    Moment,
    Playback,
    Ready,
    Select,
    Selected,
    Theme,
    ToPage,
    Viewport,
)
from app.viewer.moment_playback import FINISHED, MomentPlayback
from app.viewer.picking import floor_point, picked_node
from app.viewer.playback import Playback as PlaybackState
from app.viewer.tab_scene import TabScene
from core.geometry import FloatArray

_SETTLE_AFTER = 0.12
_SAME_ASPECT = 0.01
_TRAVEL_TIME, _TRAVEL_STEPS = 0.35, 12
"""Seconds and pictures of a camera's way from one standard view to another."""
_DEFAULT_HEIGHT = 800.0


@dataclass(frozen=True)
class Fitted:
    """A standard view that the camera was sent to, and the aspect of the picture that it fits."""

    view: View
    aspect: float


@dataclass
class TabState:
    """What a tab shows; it outlives a lost connection."""

    selected: str | None = None
    others: tuple[str, ...] = ()
    layers: dict[str, bool] = field(default_factory=lambda: dict(DEFAULT_LAYERS))
    theme: str = "light"
    view: str = "3d"
    measuring: bool = False
    points: list[tuple[float, float]] = field(default_factory=list)
    picture_height: float = _DEFAULT_HEIGHT
    camera: View | None = None


class Tab:
    """The state of a tab and the two connections that it may have. Event loop's thread only."""

    def __init__(self, token: str) -> None:
        self.token = token
        self.state = TabState()
        self.scene: TabScene | None = None
        self.mailbox: Mailbox | None = None
        self.last_used = time.monotonic()
        self.playback = PlaybackState()
        self.moment = MomentPlayback()
        self.camera_link = CameraLink(self._stand_as)
        self._fitted: Fitted | None = None
        self._aim: Fitted | None = None
        self._travel: asyncio.Task[None] | None = None
        self._settle_due: asyncio.TimerHandle | None = None

    @property
    def connected(self) -> bool:
        """Whether a page or a 3D view is there."""
        return self.scene is not None or self.mailbox is not None

    def tell(self, message: ToPage) -> None:
        """Sends a message to the page, if there is one."""
        if self.mailbox is not None:
            self.mailbox.put(message)

    def tell_ready(self) -> None:
        """Tells the page whether its 3D view is there."""
        self.tell(Ready(connected=self.scene is not None))

    def detach_page(self) -> None:
        """The page's event socket has gone."""
        self.mailbox = None
        self.last_used = time.monotonic()

    def join(self, client: viser.ClientHandle, drawing: Drawing) -> None:
        """A 3D view has connected: brings it to this tab's state."""
        self._stop_moving()
        state = self.state
        self.scene = TabScene(client, drawing)
        self.scene.wear(state.theme)
        self.scene.layers.show(self._visible(state.layers))
        self.scene.select(state.selected, state.others)
        self.scene.measure(state.points)
        self.playback.again(self.scene)
        self.moment.again(self.scene, state.theme)
        if state.camera is None:
            self._stand_at_standard(self.scene)
        else:
            far = farthest(self._standard(self.scene).view, drawing.outline)
            self.scene.stand_at(state.camera, far)
        self.camera_moved()
        self.tell_ready()

    def leave(self, client: viser.ClientHandle) -> None:
        """A 3D view has gone; nothing if another has taken its place."""
        self.last_used = time.monotonic()
        if self.scene is not None and self.scene.client.client_id == client.client_id:
            self._stop_moving()
            self.playback.stop()
            self.moment.stop()
            self.scene = None
            self.tell_ready()

    def redraw(self, drawing: Drawing) -> None:
        """The shared scene has been drawn anew."""
        known = {node.id for node in drawing.nodes}
        if self.state.selected is not None and self.state.selected not in known:
            self.state.selected, self.state.others = None, ()
            self.tell(Selected(node=None))
        if self.scene is not None:
            before = self.scene.drawing.nodes
            self.scene.redraw(drawing)
            self.scene.select(self.state.selected, self.state.others)
            self.playback.again(self.scene, other_nodes=not _same_places(before, drawing.nodes))
            self.moment.again(self.scene, self.state.theme)
            self.camera_moved()

    def handle(self, message: FromPage) -> None:
        """Does what the page asks."""
        match message:
            case Select():
                self._select(message.node, message.others)
            case Layers():
                self._show(message.layers)
            case Camera():
                self._go(message.view)
            case Measure():
                self._measure(message.on)
            case Theme():
                self.state.theme = message.theme
                if self.scene is not None:
                    self.scene.wear(message.theme)
                    self.moment.again(self.scene, message.theme)
            case Viewport():
                self.state.picture_height = message.height
                self.camera_moved()
            case Playback():
                self._play(message)
            case Moment():
                self._show_moment(message)

    def click(self, drawing: Drawing, origin: FloatArray, direction: FloatArray) -> None:
        """A click in the 3D view, as a ray in the world."""
        if self.state.measuring:
            point = floor_point(origin, direction)
            if point is not None:
                self._add_point(point)
            return
        node = picked_node(drawing, origin, direction)
        if node != self.state.selected:
            self._select(node)
            self.tell(Selected(node=node))

    def camera_moved(self) -> None:
        """The camera or the picture has changed: labels are laid out again, not too often."""
        if self.scene is not None:
            self.camera_link.moved(camera_view(self.scene.client))
        if self._settle_due is None and self.scene is not None:
            loop = asyncio.get_running_loop()
            self._settle_due = loop.call_later(_SETTLE_AFTER, self._settle)

    def close(self) -> None:
        """The view closes for good."""
        self._stop_moving()
        self.playback.stop()
        self.moment.stop()
        self.scene = None
        if self.mailbox is not None:
            self.mailbox.close()

    def _select(self, node: str | None, others: tuple[str, ...] = ()) -> None:
        self.state.selected, self.state.others = node, others
        if self.scene is not None:
            self.scene.select(node, others)
            self.camera_moved()

    def _show(self, layers: dict[str, bool]) -> None:
        known = {name: shown for name, shown in layers.items() if name in DEFAULT_LAYERS}
        self.state.layers |= known
        if self.scene is not None:
            self.scene.layers.show(self._visible(known))

    def _visible(self, layers: dict[str, bool]) -> dict[str, bool]:
        """What layers show now: those of the finished model are hidden while a moment is shown."""
        hidden = FINISHED if self.moment.shown else ()
        return {name: shown and name not in hidden for name, shown in layers.items()}

    def _show_moment(self, message: Moment) -> None:
        before = self.moment.shown
        self.moment.show(message, self.scene, self.state.theme)
        if before != self.moment.shown and self.scene is not None:
            self.scene.layers.show(self._visible(self.state.layers))
            if self._fitted is not None:
                self._go("fit")

    def _measure(self, on: bool) -> None:
        self.state.measuring = on
        self.state.points.clear()
        self._show_measured()

    def _add_point(self, point: tuple[float, float]) -> None:
        if len(self.state.points) == 2:
            self.state.points.clear()
        self.state.points.append(point)
        self._show_measured()

    def _show_measured(self) -> None:
        points = tuple(self.state.points)
        distance = float(np.hypot(*np.subtract(*points))) if len(points) == 2 else None
        if self.scene is not None:
            self.scene.measure(points)
        self.tell(Measured(points=points, distance_m=distance))

    def _play(self, message: Playback) -> None:
        begins_or_ends = (message.belief is None) != (self.playback.belief is None)
        self.playback.show(message.belief, self.scene)
        if begins_or_ends and self._fitted is not None:
            self._go("fit")

    def _go(self, view: str) -> None:
        if view != "fit":
            self.state.view = view
        self.state.camera = None
        self.tell(CameraView(view="top" if self.state.view == "top" else "3d"))
        if self.scene is not None:
            self._stop_moving()
            self._fitted = None
            self._travel = asyncio.create_task(self._travel_to_standard(self.scene))

    async def _travel_to_standard(self, scene: TabScene) -> None:
        start, target = camera_view(scene.client), self._standard(scene).view
        far = farthest(target, scene.drawing.outline)
        for step in range(1, _TRAVEL_STEPS):
            scene.stand_at(blend(start, target, step / _TRAVEL_STEPS), far)
            await asyncio.sleep(_TRAVEL_TIME / _TRAVEL_STEPS)
        self._stand_at_standard(scene)
        self.camera_moved()

    def _stand_at_standard(self, scene: TabScene) -> None:
        self._fitted = self._aim = self._standard(scene)
        scene.stand_at(self._fitted.view, farthest(self._fitted.view, scene.drawing.outline))

    def _standard(self, scene: TabScene) -> Fitted:
        aspect = scene.client.camera.aspect
        fit = fit_top if self.state.view == "top" else fit_3d
        return Fitted(fit(self.playback.outline(scene.drawing), aspect), aspect)

    def _settle(self) -> None:
        """After the camera or the picture's size has changed: fits again, lays labels out."""
        self._settle_due = None
        if self.scene is None:
            return
        view = camera_view(self.scene.client)
        if self._fitted is not None and not near(view, self._fitted.view):
            self._fitted = None
        elif self._fitted is None and self._aim is not None and near(view, self._aim.view):
            # A slow browser told where it was before it went there.
            self._fitted = self._aim
        if self._fitted is not None:
            wider = self.scene.client.camera.aspect / self._fitted.aspect
            if abs(wider - 1) > _SAME_ASPECT:
                self._stand_at_standard(self.scene)
                view = self._fitted.view
        self.state.camera = None if self._fitted is not None else view
        self.scene.declutter(view, self.state.picture_height, self.state.selected)

    def _stand_as(self, view: View) -> None:
        """Stands where the camera of the model beside this one stands."""
        if self.scene is not None:
            self._stop_moving()
            self._fitted = self._aim = None
            self.scene.stand_at(view, farthest(view, self.scene.drawing.outline))
            self.camera_moved()

    def _stop_moving(self) -> None:
        if self._travel is not None:
            self._travel.cancel()
            self._travel = None
        if self._settle_due is not None:
            self._settle_due.cancel()
            self._settle_due = None


def _same_places(old: Sequence[NodeMark], new: Sequence[NodeMark]) -> bool:
    """Whether only labels differ."""
    return [replace(node, label=None) for node in old] == [
        replace(node, label=None) for node in new
    ]


def camera_view(client: viser.ClientHandle) -> View:
    """Where a client's camera is now."""
    camera = client.camera
    position, look_at, up = (
        tuple(float(v) for v in vector)
        for vector in (camera.position, camera.look_at, camera.up_direction)
    )
    return View(position, look_at, up, float(camera.fov))  # type: ignore[arg-type]
