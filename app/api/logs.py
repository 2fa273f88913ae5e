"""Logs: upload, list, report, rename, delete."""

from __future__ import annotations

import asyncio
from http import HTTPStatus

from fastapi import APIRouter, Request
from fastapi.responses import FileResponse

from app.api.dependencies import SearchQuery, ServicesDep, SortingDep
from app.api.form_schema import file_part, form_body, text_part
from app.api.schemas import LogDetail, LogSummary, NameBody, RobotOdometry
from app.api.upload_form import receive_form
from app.jobs.reading import keep_log
from app.services import Services
from app.storage.records import LogRecord

router = APIRouter(prefix="/logs", tags=["logs"])


@router.post(
    "",
    status_code=HTTPStatus.CREATED,
    summary="Upload a log",
    openapi_extra=form_body(
        file=file_part("a log of any supported format, or a zip with a log.yaml"),
        ring=text_part("a ring preset or the text of a ring file, for logs without geometry"),
        required=("file",),
    ),
)
async def upload_log(request: Request, services: ServicesDep) -> LogDetail:
    """Keeps the log and answers with its report; 422 names the line that is wrong."""
    with services.folder.temporary() as temp:
        form = await receive_form(request, temp, services.settings.max_upload_bytes)
        upload = form.file("file")
        record = await keep_log(services, upload.path, form.fields.get("ring") or None, temp)
    return await asyncio.to_thread(_detail, services, record)


@router.get("", summary="List logs")
def list_logs(services: ServicesDep, sorting: SortingDep, q: SearchQuery = "") -> list[LogSummary]:
    """The logs whose name contains every word of `q`, the newest first."""
    return [LogSummary.of(record) for record in services.logs.search(q, sorting)]


@router.get("/{log_id}", summary="One log with its report")
def get_log(log_id: str, services: ServicesDep) -> LogDetail:
    """The log and everything that was found when it was read."""
    return _detail(services, services.logs.get(log_id))


@router.get("/{log_id}/file", summary="The log in the native format", response_class=FileResponse)
def get_log_file(log_id: str, services: ServicesDep) -> FileResponse:
    """The drive as the program understood it, gzipped JSON Lines."""
    log = services.logs.get(log_id)
    return FileResponse(
        services.logs.native_file(log.id),
        media_type="application/gzip",
        filename=f"log-{log.id}.jsonl.gz",
    )


@router.patch("/{log_id}", summary="Rename a log")
def rename_log(log_id: str, body: NameBody, services: ServicesDep) -> LogDetail:
    """Gives the log another name."""
    return _detail(services, services.logs.rename(log_id, body.name))


@router.delete("/{log_id}", status_code=HTTPStatus.NO_CONTENT, summary="Delete a log")
def delete_log(log_id: str, services: ServicesDep) -> None:
    """Removes the log; 409 while models use it."""
    services.logs.delete(log_id)


def _detail(services: Services, record: LogRecord) -> LogDetail:
    summary = LogSummary.of(record)
    known = services.calibrations.get(services.logs.ring_of(record.id))
    return LogDetail(
        **summary.model_dump(),
        report=services.logs.report(record.id),
        robot=None if known is None else RobotOdometry.of(known),
    )
