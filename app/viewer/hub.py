"""The open views: one viser server per model that somebody looks at, closed when nobody does."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import time
from collections.abc import Mapping
from dataclasses import dataclass

from app.events import ModelEvent, ModelEvents
from app.live.hub import LiveHub
from app.viewer.belief_shapes import plan_bars
from app.viewer.open_view import LoadModel, OpenView
from app.viewer.tab import Tab

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class HubConfig:
    """Seconds."""

    idle_after: float = 60.0
    """A view without a tab is closed after this long; a tab without a connection is forgotten."""
    sweep_every: float = 10.0


class Hub:
    """Opens, refreshes and closes views. Event loop's thread only, except `on_event`."""

    def __init__(
        self,
        load_model: LoadModel,
        events: ModelEvents,
        config: HubConfig | None = None,
        live: LiveHub | None = None,
    ) -> None:
        self._live = live
        self._load_model = load_model
        self._config = config or HubConfig()
        self._opening: dict[str, asyncio.Task[OpenView | None]] = {}
        self._loop: asyncio.AbstractEventLoop | None = None
        self._sweeper: asyncio.Task[None] | None = None
        self._background: set[asyncio.Task[None]] = set()
        self._unsubscribe = events.subscribe(self.on_event)

    async def view(self, model_id: str) -> OpenView | None:
        """The open view of a model, opened when it is not; None when there is no such model."""
        task = self._opening.get(model_id)
        if task is None:
            self._start()
            task = asyncio.create_task(self._open(model_id))
            self._opening[model_id] = task
        try:
            view = await asyncio.shield(task)
        except Exception:
            self._forget(model_id, task)
            raise
        if view is None:
            self._forget(model_id, task)
        return view

    def opened(self, model_id: str) -> OpenView | None:
        """The view of a model if it is open by now."""
        task = self._opening.get(model_id)
        if task is None or not task.done() or task.cancelled() or task.exception() is not None:
            return None
        return task.result()

    async def put_beside(self, model_id: str, other_id: str | None, token: str) -> None:
        """In a tab that shows two models, moving the camera of one moves the other's (None: no more)."""
        own = self._tab(model_id, token)
        view = None if other_id is None else await self.view(other_id)
        if own is not None:
            own.camera_link.join(None if view is None else view.tab(token).camera_link)

    def set_probabilities(self, model_id: str, token: str, shares: Mapping[str, float]) -> None:
        """Shows node probabilities (0..1 by node id) as bars in one tab; empty: none."""
        tab = self._tab(model_id, token)
        if tab is not None and tab.scene is not None:
            plan = plan_bars(tab.scene.drawing, shares, None) if shares else None
            tab.scene.belief.show_bars(tab.scene.drawing, plan)

    def set_robot(self, model_id: str, token: str, pose: tuple[float, float, float] | None) -> None:
        """Shows the robot at a pose in one tab, or takes it out."""
        tab = self._tab(model_id, token)
        if tab is not None and tab.scene is not None:
            tab.scene.belief.show_robot(tab.scene.drawing, pose)

    def on_event(self, event: ModelEvent, model_id: str) -> None:
        """Hears of changed and deleted models, in whatever thread; returns at once."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._react, event, model_id)

    async def close(self) -> None:
        """Ends everything."""
        self._unsubscribe()
        for running in (self._sweeper, *self._background):
            if running is not None:
                running.cancel()
                with contextlib.suppress(asyncio.CancelledError):
                    await running
        for model_id in list(self._opening):
            await self._close_view(model_id)

    def _start(self) -> None:
        if self._loop is None:
            self._loop = asyncio.get_running_loop()
            self._sweeper = asyncio.create_task(self._sweep_forever())

    async def _open(self, model_id: str) -> OpenView | None:
        model = await asyncio.to_thread(self._load_model, model_id)
        if model is None:
            return None
        view = await asyncio.to_thread(OpenView, model_id, model, asyncio.get_running_loop())
        session = self._live.running(model_id) if self._live is not None else None
        if session is not None:
            view.follow(session)
        return view

    def _react(self, event: ModelEvent, model_id: str) -> None:
        for view_id in list(self._opening):
            if view_id == model_id or (
                self._live is not None and self._live.model_of(view_id) == model_id
            ):
                self._react_in(view_id, event)

    def _react_in(self, view_id: str, event: ModelEvent) -> None:
        work = (
            self._close_view(view_id, deleted=True)
            if event is ModelEvent.DELETED
            else self._refresh(view_id)
        )
        task = asyncio.create_task(work)
        self._background.add(task)
        task.add_done_callback(self._background.discard)

    async def _refresh(self, model_id: str) -> None:
        try:
            view = await self.view(model_id)
            if view is not None and not await view.refresh(self._load_model):
                await self._close_view(model_id, deleted=True)
        except Exception:
            logger.exception("the 3D view of model %s could not be refreshed", model_id)

    async def _close_view(self, model_id: str, deleted: bool = False) -> None:
        task = self._opening.pop(model_id, None)
        if task is None:
            return
        with contextlib.suppress(Exception):
            view = await task
            if view is not None:
                await view.close(deleted)

    async def _sweep_forever(self) -> None:
        while True:
            await asyncio.sleep(self._config.sweep_every)
            idle_since = time.monotonic() - self._config.idle_after
            for model_id in list(self._opening):
                view = self.opened(model_id)
                if view is not None and view.sweep(idle_since):
                    await self._close_view(model_id)

    def _forget(self, model_id: str, task: asyncio.Task[OpenView | None]) -> None:
        if self._opening.get(model_id) is task:
            del self._opening[model_id]

    def _tab(self, model_id: str, token: str) -> Tab | None:
        view = self.opened(model_id)
        return None if view is None else view.tabs.get(token)
