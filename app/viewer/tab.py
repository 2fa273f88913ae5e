"""One tab: its page's event socket, its browser's 3D view, and what both agreed on."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

import viser

from app.viewer.camera import View
from app.viewer.camera_link import CameraLink
from app.viewer.drawing import Drawing, NodeMark
from app.viewer.drift_playback import DriftPlayback
from app.viewer.layers import DEFAULT_LAYERS
from app.viewer.live_track import LiveTrack
from app.viewer.mailbox import Mailbox
from app.viewer.measured_line import MeasuredLine
from app.viewer.messages import (
    Camera,
    CameraView,
    Drift,
    FromPage,
    Layers,
    Live,
    Measure,
    Measured,
    Moment,
    Pick,
    Picked,
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
from app.viewer.tab_camera import TabCamera, camera_view
from app.viewer.tab_live import TabLive
from app.viewer.tab_scene import TabScene
from app.viewer.tab_state import TabState
from core.geometry import FloatArray


class Tab:
    """The state of a tab and the two connections that it may have. Event loop's thread only."""

    def __init__(self, token: str, track: LiveTrack | None = None) -> None:
        """`track`: of the live session that the view shows."""
        self.token = token
        self.state = TabState()
        self.scene: TabScene | None = None
        self.mailbox: Mailbox | None = None
        self.last_used = time.monotonic()
        self.playback = PlaybackState()
        self.moment = MomentPlayback()
        self.drift = DriftPlayback()
        self.camera_link = CameraLink(self._stand_as)
        self.camera = TabCamera(self._outline, self._aspect, self._declutter)
        self.live = None if track is None else TabLive(track, self.playback, self.camera)

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
        state = self.state
        self.scene = TabScene(client, drawing)
        self.scene.wear(state.theme)
        self.scene.layers.show(self._visible(state.layers))
        self._mark()
        self.scene.measure(state.measured.points)
        self.playback.again(self.scene)
        self.moment.again(self.scene, state.theme)
        self.drift.again(self.scene, state.theme)
        if self.live is not None:
            self.live.join(self.scene)
        self.camera.join(self.scene)
        self.tell_ready()

    def leave(self, client: viser.ClientHandle) -> None:
        """A 3D view has gone; nothing if another has taken its place."""
        self.last_used = time.monotonic()
        if self.scene is not None and self.scene.client.client_id == client.client_id:
            self.camera.stop()
            self.playback.stop()
            self.moment.stop()
            self.drift.stop()
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
            self._mark()
            self.playback.again(self.scene, other_nodes=not _same_places(before, drawing.nodes))
            self.moment.again(self.scene, self.state.theme)
            self.drift.again(self.scene, self.state.theme)
            if self.live is not None:
                self.live.redraw(self.scene)
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
                    self.drift.again(self.scene, message.theme)
            case Viewport():
                self.state.picture_height = message.height
                self.state.aspect = message.width / message.height
                self.camera_moved()
            case Playback():
                self._play(message)
            case Moment():
                self._show_moment(message)
            case Live():
                if self.live is not None:
                    self.live.show(message, self.scene)
            case Pick():
                self.state.picking = message.on
            case Drift():
                self._show_drift(message)

    def click(self, drawing: Drawing, origin: FloatArray, direction: FloatArray) -> None:
        """A click in the 3D view, as a ray in the world."""
        if self.state.picking:
            point = floor_point(origin, direction)
            if point is not None:
                self.tell(Picked(x=point[0], y=point[1]))
            return
        if self.state.measuring:
            point = floor_point(origin, direction)
            if point is not None:
                self.state.measured.add(point)
                self._show_measured()
            return
        if self.drift.shown and drawing.drift is not None:
            point = floor_point(origin, direction)
            if point is not None:
                self.tell(self.drift.pointed(drawing.drift, point))
            return
        node = picked_node(drawing, origin, direction)
        if node != self.state.selected and not self.moment.shown:
            self._select(node)
            self.tell(Selected(node=node))

    def live_ended(self) -> None:
        """The live session is over; the model stays."""
        if self.live is not None:
            self.live.end(self.scene)
        self.live = None

    def camera_moved(self) -> None:
        """The camera or the picture has changed: labels are laid out again, not too often."""
        if self.scene is not None:
            self.camera_link.moved(camera_view(self.scene.client))
            self.camera.moved(self.scene)

    def close(self) -> None:
        """The view closes for good."""
        self.camera.stop()
        self.playback.stop()
        self.moment.stop()
        self.drift.stop()
        self.scene = None
        if self.mailbox is not None:
            self.mailbox.close()

    def _select(self, node: str | None, others: tuple[str, ...] = ()) -> None:
        self.state.selected, self.state.others = node, others
        if self.scene is not None:
            self._mark()
            self.camera_moved()

    def _show(self, layers: dict[str, bool]) -> None:
        known = {name: shown for name, shown in layers.items() if name in DEFAULT_LAYERS}
        self.state.layers |= known
        if self.scene is not None:
            self.scene.layers.show(self._visible(known))

    @property
    def _looks_back(self) -> bool:
        """Whether the drive is shown instead of the finished model."""
        return self.moment.shown or self.drift.shown

    def _mark(self) -> None:
        """Marks what is selected, unless the drive is shown: its moments had other regions."""
        if self.scene is not None:
            shown = (None, ()) if self._looks_back else (self.state.selected, self.state.others)
            self.scene.select(*shown)

    def _visible(self, layers: dict[str, bool]) -> dict[str, bool]:
        """What layers show now: those of the finished model are hidden while its past is shown."""
        hidden = FINISHED if self._looks_back else ()
        return {name: shown and name not in hidden for name, shown in layers.items()}

    def _show_moment(self, message: Moment) -> None:
        before = self.moment.shown
        self.moment.show(message, self.scene, self.state.theme)
        if before != self.moment.shown and self.scene is not None:
            self.scene.layers.show(self._visible(self.state.layers))
            self._mark()
            if self.camera.kept is None:
                self._go("fit")

    def _show_drift(self, message: Drift) -> None:
        before = self.drift.shown
        self.drift.show(message, self.scene, self.state.theme)
        if before != self.drift.shown and self.scene is not None:
            self.scene.layers.show(self._visible(self.state.layers))
            self._mark()

    def _measure(self, on: bool) -> None:
        self.state.measuring = on
        self.state.measured = MeasuredLine()
        self._show_measured()

    def _show_measured(self) -> None:
        line = self.state.measured
        if self.scene is not None:
            self.scene.measure(line.points)
        self.tell(Measured(points=line.points, distance_m=line.distance_m))

    def _play(self, message: Playback) -> None:
        if self.live is not None:
            return
        begins_or_ends = (message.belief is None) != (self.playback.belief is None)
        self.playback.show(message.belief, self.scene)
        if begins_or_ends and self.camera.kept is None:
            self._go("fit")

    def _go(self, view: str) -> None:
        self.camera.go(self.scene, None if view == "fit" else view)
        self.tell(CameraView(view="top" if self.camera.standard == "top" else "3d"))

    def _outline(self, scene: TabScene) -> FloatArray:
        """(K, 2) what must be in the picture."""
        if self.live is not None:
            return self.live.outline(scene.drawing, self.playback.outline(scene.drawing))
        return self.playback.outline(scene.drawing)

    def _aspect(self, scene: TabScene) -> float:
        """Of the picture. The browser's own camera hears late, or never, that its frame has changed."""
        return self.state.aspect or scene.client.camera.aspect

    def _declutter(self, view: View) -> None:
        if self.scene is not None:
            self.scene.declutter(view, self.state.picture_height, self.state.selected)

    def _stand_as(self, view: View) -> None:
        """Stands where the camera of the model beside this one stands."""
        if self.scene is not None:
            self.camera.follow(self.scene, view)
            self.camera.moved(self.scene)


def _same_places(old: Sequence[NodeMark], new: Sequence[NodeMark]) -> bool:
    """Whether only labels differ."""
    return [replace(node, label=None) for node in old] == [
        replace(node, label=None) for node in new
    ]
