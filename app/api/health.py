"""Whether the server is ready, and what it allows."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

from fastapi import APIRouter
from pydantic import BaseModel

from app.api.dependencies import ServicesDep

router = APIRouter(tags=["server"])


class Health(BaseModel):
    """The state of the server."""

    status: str
    version: str
    max_upload_bytes: int
    jobs_running: int
    jobs_waiting: int


@router.get("/health", summary="Whether the server is ready")
async def health(services: ServicesDep) -> Health:
    """200 when ready, with the limits that a page wants to know before it sends something."""
    running, waiting = services.runner.counts()
    return Health(
        status="ok",
        version=product_version(),
        max_upload_bytes=services.settings.max_upload_bytes,
        jobs_running=running,
        jobs_waiting=waiting,
    )


def product_version() -> str:
    """The installed version."""
    try:
        return version("echorooms")
    except PackageNotFoundError:
        return "0"
