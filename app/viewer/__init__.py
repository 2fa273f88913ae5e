"""The 3D view: everything under `/view/`. The only package that imports viser."""

from __future__ import annotations

import asyncio
import contextlib
import secrets
from collections.abc import AsyncIterator
from typing import Annotated

from fastapi import APIRouter, FastAPI, Path, Query, Request, WebSocket, WebSocketDisconnect
from fastapi.responses import Response
from pydantic import ValidationError

from app.errors import NotFound
from app.events import ModelEvents
from app.live.hub import LiveHub
from app.settings import Settings
from app.viewer.bridge import bridge
from app.viewer.hub import Hub, HubConfig
from app.viewer.mailbox import Mailbox
from app.viewer.messages import FROM_PAGE, Beside
from app.viewer.open_view import LoadModel
from app.viewer.page import view_page
from app.viewer.tab import Tab

NO_SUCH_MODEL, BAD_MESSAGE = 4404, 1003
LARGEST_MESSAGE = 1 << 16
Token = Annotated[str, Path(pattern=r"^[A-Za-z0-9_-]{8,64}$")]
QueryToken = Annotated[str, Query(pattern=r"^[A-Za-z0-9_-]{8,64}$")]


def attach(
    app: FastAPI,
    load_model: LoadModel,
    events: ModelEvents,
    settings: Settings,
    config: HubConfig | None = None,
    live: LiveHub | None = None,
) -> None:
    """Adds the 3D view to an app.

    Args:
        load_model: the stored model of an id as it is now, or None; called in a thread.
        events: heard for models that change or go.
        settings: the app's settings; Host and Origin are checked by the app's guard.
        config: when views are closed.
        live: the live sessions, which are shown under their ids.

    The hub is `app.state.viewer`, for what plays back in a tab.
    """
    hub = Hub(load_model, events, config, live)
    app.state.viewer = hub

    @contextlib.asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        try:
            yield
        finally:
            await hub.close()

    router = APIRouter(prefix="/view", lifespan=lifespan, include_in_schema=False)
    _add_pages(router, hub)
    _add_sockets(router, hub)
    app.include_router(router)


def _add_pages(router: APIRouter, hub: Hub) -> None:
    @router.get("/{model_id}/")
    async def page(model_id: str, request: Request) -> Response:
        return await _page(hub, model_id, request)

    @router.get("/{model_id}/tab/{token}/")
    async def page_of_tab(model_id: str, token: Token, request: Request) -> Response:
        return await _page(hub, model_id, request)


def _add_sockets(router: APIRouter, hub: Hub) -> None:
    @router.websocket("/{model_id}/events")
    async def events_of_tab(websocket: WebSocket, model_id: str, tab: QueryToken) -> None:
        view = await hub.view(model_id)
        await websocket.accept()
        if view is None:
            await websocket.close(NO_SUCH_MODEL, "there is no such model")
            return
        chosen = view.tab(tab)
        mailbox = Mailbox()
        if chosen.mailbox is not None:
            chosen.mailbox.close()
        chosen.mailbox = mailbox
        mailbox.put(view.hello(chosen))
        if view.feed is not None:
            mailbox.put(view.feed.span())
        if chosen.scene is not None:
            chosen.tell_ready()
        await _talk(websocket, hub, model_id, chosen, mailbox)

    @router.websocket("/{model_id}/tab/{token}")
    async def view_of_tab(websocket: WebSocket, model_id: str, token: Token) -> None:
        await _view(hub, websocket, model_id, token)

    @router.websocket("/{model_id}")
    async def view_alone(websocket: WebSocket, model_id: str) -> None:
        await _view(hub, websocket, model_id, secrets.token_urlsafe(16))


async def _page(hub: Hub, model_id: str, request: Request) -> Response:
    if await hub.view(model_id) is None:
        raise NotFound("model", model_id)
    return view_page().response(request)


async def _view(hub: Hub, websocket: WebSocket, model_id: str, token: str) -> None:
    view = await hub.view(model_id)
    if view is None:
        await websocket.close(NO_SUCH_MODEL, "there is no such model")
        return
    view.tab(token)
    await bridge(websocket, view.server.url_for(token))


async def _talk(websocket: WebSocket, hub: Hub, model_id: str, tab: Tab, mailbox: Mailbox) -> None:
    """Serves one event socket until either side ends it."""
    sending = asyncio.create_task(_send(websocket, mailbox))
    try:
        while True:
            text = await websocket.receive_text()
            if len(text) > LARGEST_MESSAGE:
                raise ValueError("message too big")
            message = FROM_PAGE.validate_json(text)
            if isinstance(message, Beside):
                await hub.put_beside(model_id, message.model, tab.token)
            else:
                tab.handle(message)
    except (WebSocketDisconnect, RuntimeError):
        pass
    except (ValidationError, ValueError, KeyError):
        with contextlib.suppress(RuntimeError):
            await websocket.close(BAD_MESSAGE, "not a message of this channel")
    finally:
        sending.cancel()
        if tab.mailbox is mailbox:
            tab.detach_page()


async def _send(websocket: WebSocket, mailbox: Mailbox) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while (message := await mailbox.take()) is not None:
            await websocket.send_text(message.model_dump_json())
        await websocket.close()


__all__ = ["attach"]
