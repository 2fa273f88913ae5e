"""The application: everything under one address."""

from __future__ import annotations

import asyncio
import contextlib
import importlib.util
from collections.abc import AsyncIterator
from typing import TYPE_CHECKING

from fastapi import APIRouter, FastAPI

from app.api import docs_page, health, jobs, labels, logs, models
from app.api.static_pages import STATIC_FOLDER, StaticPages
from app.body_limit import BodyLimit
from app.demo import load_samples
from app.errors import install_error_handlers
from app.events import ModelEvents
from app.security import BrowserGuard
from app.services import Services, open_services
from app.settings import Settings

if TYPE_CHECKING:
    from core.topology import Model

DESCRIPTION = "Sonar logs in, maps with named rooms out. All lengths in metres, angles in radians."


def create_app(settings: Settings) -> FastAPI:
    """The app; it touches the data folder only between its start and its end (lifespan)."""
    events = ModelEvents()

    @contextlib.asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        async with open_services(settings, events) as services:
            app.state.services = services
            loading = asyncio.create_task(load_samples(services)) if settings.demo else None
            yield
            if loading is not None:
                loading.cancel()
                await asyncio.wait([loading])

    app = FastAPI(
        title="EchoRooms",
        version=health.product_version(),
        description=DESCRIPTION,
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
    )
    app.state.events = events
    app.state.settings = settings
    install_error_handlers(app)
    api = APIRouter(prefix="/api")
    for router in (health.router, logs.router, models.router, labels.router, jobs.router):
        api.include_router(router)
    app.include_router(api)
    app.include_router(docs_page.router)
    _attach_view(app, settings, events)
    app.mount("/", StaticPages(app, STATIC_FOLDER), name="static")
    app.add_middleware(BodyLimit)
    app.add_middleware(BrowserGuard, settings=settings)
    return app


def _attach_view(app: FastAPI, settings: Settings, events: ModelEvents) -> None:
    """Adds the 3D view, which reads models from the store that the running app has."""
    if importlib.util.find_spec("app.viewer") is None:
        return
    from app.viewer import attach

    def load_model(model_id: str) -> Model | None:
        services: Services = app.state.services
        return services.models.load(model_id)

    attach(app, load_model, events, settings)
