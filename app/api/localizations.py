"""Localizations: where a robot was along a log, in the nodes of a model."""

from __future__ import annotations

import asyncio
from datetime import datetime
from http import HTTPStatus
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query
from pydantic import BaseModel, Field

from app.api.dependencies import ServicesDep
from app.api.schemas import Accepted, Body, moment
from app.jobs.localizing import localize_a_log
from app.storage.records import LocalizationRecord, Status

router = APIRouter(prefix="/localizations", tags=["localizations"])


class LocalizationBody(Body):
    """A localization to be made."""

    model_id: str = Field(max_length=64)
    log_id: str = Field(max_length=64)
    method: Literal["default", "paper", "mcl"] = "default"
    step: float = Field(2.5, ge=0.2, le=50, description="metres of travel between two steps")


class LocalizationSummary(BaseModel):
    """A localization without its steps."""

    id: str
    name: str
    created: datetime
    model_id: str
    log_id: str
    status: Status
    error: str | None
    job_id: str | None
    options: dict[str, Any]
    steps: int


def _summary(record: LocalizationRecord) -> LocalizationSummary:
    fields = vars(record) | {"created": moment(record.created), "options": record.options}
    return LocalizationSummary(**fields)


@router.post("", status_code=HTTPStatus.ACCEPTED, summary="Localize a log in a model")
async def create_localization(body: LocalizationBody, services: ServicesDep) -> Accepted:
    """Begins to localize; the job tells how far it is."""
    options = {"method": body.method, "step": body.step}
    record, job = await localize_a_log(services, body.model_id, body.log_id, options)
    return Accepted(id=record.id, job_id=job.id)


@router.get("", summary="List localizations")
def list_localizations(
    services: ServicesDep,
    model_id: Annotated[str | None, Query(max_length=64, description="of this model only")] = None,
) -> list[LocalizationSummary]:
    """All localizations, the newest first."""
    return [_summary(record) for record in services.localizations.list_all(model_id)]


@router.get("/{localization_id}", summary="A localization")
def get_localization(localization_id: str, services: ServicesDep) -> LocalizationSummary:
    """How far it is and what it was made of."""
    return _summary(services.localizations.get(localization_id))


@router.get("/{localization_id}/steps", summary="The steps of a localization")
def get_steps(localization_id: str, services: ServicesDep) -> list[dict[str, Any]]:
    """One entry per time step, a rejected one too, as `echorooms localize` writes them."""
    return services.localizations.steps(localization_id)


@router.delete(
    "/{localization_id}", status_code=HTTPStatus.NO_CONTENT, summary="Delete a localization"
)
async def delete_localization(localization_id: str, services: ServicesDep) -> None:
    """Stops its job, if it is still at work, and removes it."""
    record = await asyncio.to_thread(services.localizations.get, localization_id)
    if record.job_id is not None and not record.status.ended:
        await services.runner.cancel(record.job_id)
    await asyncio.to_thread(services.localizations.delete, localization_id)
