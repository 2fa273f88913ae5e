"""Jobs: how far they are, as a stream too, and cancelling."""

from __future__ import annotations

from collections.abc import AsyncIterator

from fastapi import APIRouter
from fastapi.responses import StreamingResponse

from app.api.dependencies import ServicesDep
from app.api.schemas import JobDetail
from app.services import Services

router = APIRouter(prefix="/jobs", tags=["jobs"])
HEARTBEAT = ": still here\n\n"
STREAM_HEADERS = {"cache-control": "no-store", "x-accel-buffering": "no"}


@router.get("/{job_id}", summary="One job")
def get_job(job_id: str, services: ServicesDep) -> JobDetail:
    """How far the job is."""
    return JobDetail.of(services.runner.view(job_id))


@router.get(
    "/{job_id}/events",
    summary="Follow a job (server-sent events)",
    response_class=StreamingResponse,
    responses={200: {"content": {"text/event-stream": {}}, "description": "one job an event"}},
)
async def follow_job(job_id: str, services: ServicesDep) -> StreamingResponse:
    """The job now, after every change and at its end, each as an event; then the stream ends."""
    services.runner.view(job_id)
    return StreamingResponse(
        _events(services, job_id), media_type="text/event-stream", headers=STREAM_HEADERS
    )


@router.delete("/{job_id}", summary="Cancel a job")
async def cancel_job(job_id: str, services: ServicesDep) -> JobDetail:
    """Stops the job and answers when it is over; a job that has ended stays as it is."""
    return JobDetail.of(await services.runner.cancel(job_id))


async def _events(services: Services, job_id: str) -> AsyncIterator[str]:
    async for view in services.runner.watch(job_id, services.settings.heartbeat_s):
        if view is None:
            yield HEARTBEAT
        else:
            yield f"data: {JobDetail.of(view).model_dump_json()}\n\n"
