"""An open model: its viser server, its drawing and its tabs."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable, Sequence

import numpy as np
import viser

from app.live.session import LiveSession
from app.viewer.camera import View, fit_3d
from app.viewer.drawing import draw, relabelled
from app.viewer.live_feed import LiveFeed
from app.viewer.messages import Hello, Labels, ModelChanged, ModelDeleted
from app.viewer.palette import hex_of
from app.viewer.scene import ModelScene, label_text
from app.viewer.tab import Tab
from app.viewer.viser_server import PrivateViser
from core.topology import Model

logger = logging.getLogger(__name__)

LoadModel = Callable[[str], Model | None]
"""The stored model of an id as it is now, or None; called in a thread."""


class OpenView:
    """The 3D view of one model, shared by all tabs that show it. Event loop's thread only,
    except where a method says otherwise."""

    def __init__(self, model_id: str, model: Model, loop: asyncio.AbstractEventLoop) -> None:
        """Draws the model and starts its server. Heavy: call it in a thread."""
        self.model_id = model_id
        self.model = model
        self.drawing = draw(model)
        self.tabs: dict[str, Tab] = {}
        self.feed: LiveFeed | None = None
        self.last_used = time.monotonic()
        self._loop = loop
        self._stale = False
        self._refreshing = asyncio.Lock()
        self.server = PrivateViser()
        self._scene = ModelScene(self.server)
        self._scene.draw(self.drawing)
        self._first_view = self._place_first_camera()
        self.server.scene.on_click()(self._clicked)
        self.server.on_client_connect(self._client_connected)
        self.server.on_client_disconnect(self._client_gone)

    def follow(self, session: LiveSession) -> None:
        """Shows a live session over the model that grows with it, or in which the robot is."""
        self.feed = LiveFeed(session, lambda: list(self.tabs.values()))

    def tab(self, token: str) -> Tab:
        """The tab of a token, made when it is new."""
        self.last_used = time.monotonic()
        if token not in self.tabs:
            self.tabs[token] = Tab(token, self.feed.track if self.feed is not None else None)
            self.tabs[token].camera.first = self._first_view
        return self.tabs[token]

    def hello(self, tab: Tab) -> Hello:
        """What a page is told first."""
        return Hello(
            model=self.model_id,
            layers=tab.state.layers,
            colours=self.colours(),
            labels=self.labels(),
            selected=tab.state.selected,
        )

    def colours(self) -> dict[str, str]:
        """`#rrggbb` by node id."""
        return {node.id: hex_of(node.colour) for node in self.drawing.nodes}

    def labels(self) -> dict[str, str | None]:
        """Label by node id."""
        return {node.id: node.label for node in self.model.topology.nodes}

    async def refresh(self, load_model: LoadModel) -> bool:
        """Shows the model as it is stored now; False when it is gone.

        Events that arrive while one refresh runs are served by one more.
        """
        self._stale = True
        async with self._refreshing:
            if not self._stale:
                return True
            self._stale = False
            model = await asyncio.to_thread(load_model, self.model_id)
            if model is None:
                return False
            await self._show(model)
            return True

    def sweep(self, idle_since: float) -> bool:
        """Forgets tabs that nobody has used since then; True when the view itself can be closed."""
        for token, tab in list(self.tabs.items()):
            if not tab.connected and tab.last_used < idle_since:
                del self.tabs[token]
        if self.tabs:
            self.last_used = time.monotonic()
        return not self.tabs and self.last_used < idle_since

    async def close(self, deleted: bool = False) -> None:
        """Ends every tab and the server."""
        if self.feed is not None:
            self.feed.close()
        for tab in self.tabs.values():
            if deleted:
                tab.tell(ModelDeleted())
            tab.close()
        self.tabs.clear()
        await asyncio.to_thread(self.server.stop)

    async def _show(self, model: Model) -> None:
        same = _same_drawing(self.model, model)
        regrouped = self.model.topology.rooms != model.topology.rooms
        self.model = model
        if same:
            self.drawing = relabelled(self.drawing, self.labels())
            regions = {node.id: node.region for node in self.drawing.nodes}
            self._scene.set_labels(
                {node: label_text(label, regions[node]) for node, label in self.labels().items()}
            )
        else:
            self.drawing = await asyncio.to_thread(draw, model, None, self.drawing)
            await asyncio.to_thread(self._scene.draw, self.drawing)
        news = Labels(labels=self.labels(), colours=self.colours())
        for tab in self.tabs.values():
            tab.redraw(self.drawing)
            tab.tell(news)
            if not same or regrouped:
                tab.tell(ModelChanged())

    def _place_first_camera(self) -> View:
        """Where a browser looks before its tab's own camera is set."""
        view = fit_3d(self.drawing.outline, 1.4)
        first = self.server.initial_camera
        first.position, first.look_at = view.position, view.look_at
        first.fov = view.fov
        return view

    def _client_connected(self, client: viser.ClientHandle) -> None:
        """Called by viser, in a thread of its own."""
        client.camera.on_update(lambda _: self._on_loop(self._camera_moved, client))
        self._on_loop(self._join, client)

    def _client_gone(self, client: viser.ClientHandle) -> None:
        """Called by viser, in a thread of its own."""
        self._on_loop(self._leave, client)

    def _clicked(self, event: viser.SceneClickEvent) -> None:
        """Called by viser, in a thread of its own."""
        if event.ray_origin is not None and event.ray_direction is not None:
            self._on_loop(self._click, event.client, event.ray_origin, event.ray_direction)

    def _on_loop(self, function: Callable[..., None], *args: object) -> None:
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(function, *args)

    def _join(self, client: viser.ClientHandle) -> None:
        token = self.server.tab_of(client)
        if token is not None and client.client_id in self.server.get_clients():
            self.tab(token).join(client, self.drawing)

    def _leave(self, client: viser.ClientHandle) -> None:
        for tab in self.tabs.values():
            tab.leave(client)

    def _camera_moved(self, client: viser.ClientHandle) -> None:
        tab = self._tab_of(client)
        if tab is not None:
            tab.camera_moved()

    def _click(
        self, client: viser.ClientHandle, origin: Sequence[float], direction: Sequence[float]
    ) -> None:
        tab = self._tab_of(client)
        if tab is not None:
            tab.click(self.drawing, np.array(origin, float), np.array(direction, float))

    def _tab_of(self, client: viser.ClientHandle) -> Tab | None:
        for tab in self.tabs.values():
            if tab.scene is not None and tab.scene.client.client_id == client.client_id:
                return tab
        return None


def _same_drawing(old: Model, new: Model) -> bool:
    """Whether only labels differ."""

    def shape_of(model: Model) -> object:
        topology = model.topology
        return (
            [(node.id, node.region, node.position, node.area_m2) for node in topology.nodes],
            topology.edges,
            model.grid.geometry,
        )

    return (
        shape_of(old) == shape_of(new)
        and np.array_equal(old.grid.state, new.grid.state)
        and np.array_equal(old.regions, new.regions)
        and old.drift == new.drift
    )
