"""The application: everything under one address."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator
from typing import TYPE_CHECKING

from fastapi import APIRouter, FastAPI

from app.access import Access
from app.api import (
    comparisons,
    docs_page,
    drift,
    edits,
    health,
    jobs,
    labels,
    live,
    localizations,
    logs,
    models,
    robots,
    timeline,
)
from app.api.static_pages import STATIC_FOLDER, StaticPages
from app.body_limit import BodyLimit
from app.demo import send_a_robot, show_samples
from app.errors import PROBLEM_RESPONSES, install_error_handlers
from app.events import ModelEvents
from app.lazy_view import LazyView
from app.live.blank_model import blank_model
from app.live.hub import LiveHub
from app.robots.fleet import RobotFleet
from app.security import BrowserGuard
from app.services import Services, open_services
from app.settings import Settings
from app.token_guard import TokenGuard

if TYPE_CHECKING:
    from core.topology import Model

DESCRIPTION = "Sonar logs in, maps with named rooms out. All lengths in metres, angles in radians."


def create_app(settings: Settings, access: Access | None = None) -> FastAPI:
    """The app; it touches the data folder only between its start and its end (lifespan).

    Args:
        settings: what it is told.
        access: its tokens; without, everybody who reaches it may do everything.
    """
    events = ModelEvents()
    app = FastAPI(
        title="EchoRooms",
        version=health.product_version(),
        description=DESCRIPTION,
        lifespan=_lifespan,
        docs_url=None,
        redoc_url=None,
    )
    app.state.settings = settings
    app.state.events = events
    app.state.address = None
    app.state.access = access
    app.state.view = LazyView(
        lambda view_id: _load_model(app, view_id), events, settings, lambda: app.state.live
    )
    install_error_handlers(app)
    api = APIRouter(prefix="/api", responses=PROBLEM_RESPONSES)
    for router in (
        health.router,
        logs.router,
        models.router,
        timeline.router,
        comparisons.router,
        labels.router,
        edits.router,
        drift.router,
        localizations.router,
        jobs.router,
        live.router,
        robots.router,
    ):
        api.include_router(router)
    app.include_router(api)
    app.include_router(docs_page.router)
    app.router.routes.append(app.state.view)
    app.mount("/", StaticPages(app, STATIC_FOLDER), name="static")
    app.add_middleware(BodyLimit)
    app.add_middleware(TokenGuard, access=access)
    app.add_middleware(BrowserGuard, settings=settings)
    return app


@contextlib.asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    async with open_services(app.state.settings, app.state.events) as services:
        app.state.services = services
        app.state.live = LiveHub(services)
        await app.state.live.recover()
        app.state.robots = RobotFleet(app.state.live, lambda: _own_address(app))
        await app.state.robots.recover()
        background = _start_demo(app) if services.settings.demo else []
        if services.settings.mqtt_url:
            from app.live.mqtt_link import Broker, follow_broker

            broker = Broker.of(services.settings.mqtt_url)
            link = follow_broker(broker, app.state.live, services.settings)
            background.append(asyncio.create_task(link, name="MQTT"))
        yield
        for task in background:
            task.cancel()
        await asyncio.gather(*background, return_exceptions=True)
        await app.state.robots.close()
        await app.state.live.close()
        await app.state.view.close()


def _own_address(app: FastAPI) -> str | None:
    """The URL, with a token where one is asked for, at which the server's robots reach it."""
    address, access = app.state.address, app.state.access
    if address is None or access is None:
        return None if address is None else str(address)
    scheme, _, rest = str(address).partition("://")
    return f"{scheme}://:{access.inner_token}@{rest}"


def _start_demo(app: FastAPI) -> list[asyncio.Task[None]]:
    """The samples are loaded and a robot drives, while the pages are served already."""
    return [
        asyncio.create_task(show_samples(app.state.services)),
        asyncio.create_task(send_a_robot(app.state.robots)),
    ]


def _load_model(app: FastAPI, view_id: str) -> Model | None:
    """What the view of a model or a live session shows: the stored model as it is now."""
    services: Services = app.state.services
    live: LiveHub = app.state.live
    model, session = services.models.load(live.model_of(view_id)), live.running(view_id)
    if model is None and session is not None:
        return blank_model(session.recording.path)
    return model
