"""The 3D view, loaded when somebody first looks: its libraries would double the time of every start."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Callable
from typing import TYPE_CHECKING

from fastapi import FastAPI
from starlette.routing import BaseRoute, Match
from starlette.types import Receive, Scope, Send

from app.errors import install_error_handlers
from app.events import ModelEvents
from app.settings import Settings

if TYPE_CHECKING:
    from app.live.hub import LiveHub
    from core.topology import Model

VIEW_PREFIX = "/view/"


class LazyView(BaseRoute):
    """A route that gives everything below `/view/` to `app.viewer`, in an app of its own."""

    def __init__(
        self,
        load_model: Callable[[str], Model | None],
        events: ModelEvents,
        settings: Settings,
        live: Callable[[], LiveHub],
    ) -> None:
        """`live` gives the live sessions of the running app."""
        self._load_model = load_model
        self._live = live
        self._events = events
        self._settings = settings
        self._view: FastAPI | None = None
        self._loading = asyncio.Lock()
        self._open = contextlib.AsyncExitStack()

    def matches(self, scope: Scope) -> tuple[Match, Scope]:
        """Whether a connection is for the view."""
        mine = scope["type"] in ("http", "websocket") and scope["path"].startswith(VIEW_PREFIX)
        return (Match.FULL if mine else Match.NONE), {}

    async def handle(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serves one connection."""
        async with self._loading:
            if self._view is None:
                view = await asyncio.to_thread(self._make)
                await self._open.enter_async_context(view.router.lifespan_context(view))
                self._view = view
        await self._view(scope, receive, send)

    async def close(self) -> None:
        """Closes every open view."""
        await self._open.aclose()

    def _make(self) -> FastAPI:
        from app.viewer import attach

        view = FastAPI(openapi_url=None)
        install_error_handlers(view)
        attach(view, self._load_model, self._events, self._settings, live=self._live())
        return view
