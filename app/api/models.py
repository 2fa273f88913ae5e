"""Models: make, list, look at, rename, delete."""

from __future__ import annotations

import asyncio
from http import HTTPStatus
from typing import Any

from fastapi import APIRouter, Request, Response

from app.api.dependencies import SearchQuery, ServicesDep, SortingDep
from app.api.form_schema import file_part, form_body, text_part
from app.api.model_downloads import grid_png, zipped
from app.api.schemas import (
    Accepted,
    ImportFields,
    LogIdBody,
    ModelBody,
    ModelDetail,
    ModelSummary,
    NameBody,
    summary_fields,
)
from app.api.upload_form import parse_fields, receive_form
from app.jobs.modelling import continue_model, model_a_log, model_a_map
from app.jobs.reading import read_upload
from app.services import Services
from app.storage.model_facts import TOPOLOGY_FILE, read_json
from app.storage.records import ModelRecord

router = APIRouter(prefix="/models", tags=["models"])
PROVENANCE_FILE = "provenance.json"


@router.post("", status_code=HTTPStatus.ACCEPTED, summary="Model a log")
async def create_model(body: ModelBody, services: ServicesDep) -> Accepted:
    """Begins to make a model; the job tells how far it is."""
    model, job = await model_a_log(
        services,
        body.log_id,
        body.name,
        body.options(),
        body.labels_from,
        known_robot=body.calibration == "robot",
    )
    return Accepted(id=model.id, job_id=job.id)


@router.post(
    "/import",
    status_code=HTTPStatus.ACCEPTED,
    summary="Model a map",
    openapi_extra=form_body(
        yaml=file_part("a ROS map_server map.yaml"),
        image=file_part("its image (PGM or PNG)"),
        regions=text_part("number of regions; found automatically without it"),
        method=text_part("default or paper"),
        name=text_part("what to call the model"),
        required=("yaml", "image"),
    ),
)
async def import_map(request: Request, services: ServicesDep) -> Accepted:
    """Begins to cut an existing map into regions; the job tells how far it is."""
    with services.folder.temporary() as temp:
        form = await receive_form(request, temp, services.settings.max_upload_bytes)
        yaml, image, source = form.file("yaml"), form.file("image"), temp / "source"
        fields = parse_fields(ImportFields, form.fields)
        arguments = {"yaml": str(yaml.path), "image": str(image.path), "out": str(source)}
        await read_upload(services, "check_map", arguments)
        name = fields.name or yaml.path.stem
        model, job = await model_a_map(services, source, name, fields.options())
    return Accepted(id=model.id, job_id=job.id)


@router.post("/{model_id}/logs", status_code=HTTPStatus.ACCEPTED, summary="Go on with another log")
async def add_log(model_id: str, body: LogIdBody, services: ServicesDep) -> Accepted:
    """Makes the model again from its logs and one more of the same drive; labels are kept."""
    job = await continue_model(services, model_id, body.log_id)
    return Accepted(id=model_id, job_id=job.id)


@router.get("", summary="List models")
def list_models(
    services: ServicesDep, sorting: SortingDep, q: SearchQuery = ""
) -> list[ModelSummary]:
    """The models with every word of `q` in their name or labels, the newest first."""
    return [ModelSummary.of(record) for record in services.models.search(q, sorting)]


@router.get("/{model_id}", summary="One model with its topology")
def get_model(model_id: str, services: ServicesDep) -> ModelDetail:
    """Nodes, edges, rooms, status and provenance."""
    return model_detail(services, services.models.get(model_id))


@router.patch("/{model_id}", summary="Rename a model")
def rename_model(model_id: str, body: NameBody, services: ServicesDep) -> ModelDetail:
    """Gives the model another name."""
    return model_detail(services, services.models.rename(model_id, body.name))


@router.delete("/{model_id}", status_code=HTTPStatus.NO_CONTENT, summary="Delete a model")
async def delete_model(model_id: str, services: ServicesDep) -> None:
    """Removes the model; a job that still makes it is cancelled."""
    record = await asyncio.to_thread(services.models.get, model_id)
    if record.job_id is not None:
        await services.runner.cancel(record.job_id)
    await asyncio.to_thread(services.models.delete, model_id)


@router.get(
    "/{model_id}/folder.zip",
    summary="The model folder to take away",
    response_class=Response,
    responses={200: {"content": {"application/zip": {}}}},
)
def get_model_folder(model_id: str, services: ServicesDep) -> Response:
    """Everything that is known of the model, as files that other programs read."""
    content = zipped(services.models.folder(model_id))
    disposition = {"content-disposition": f'attachment; filename="model-{model_id}.zip"'}
    return Response(content, media_type="application/zip", headers=disposition)


@router.get(
    "/{model_id}/grid.png",
    summary="The grid as a picture",
    response_class=Response,
    responses={200: {"content": {"image/png": {}}}},
)
def get_grid_picture(model_id: str, services: ServicesDep) -> Response:
    """White is free, black occupied, grey unknown; row 0 is the top."""
    return Response(grid_png(services.models.folder(model_id)), media_type="image/png")


def model_detail(services: Services, record: ModelRecord) -> ModelDetail:
    """A model as its files tell; without nodes until it is made."""
    fields = summary_fields(record)
    while record.revision:
        try:
            folder = services.models.folder(record.id)
            topology = read_json(folder / TOPOLOGY_FILE)
            fields |= topology | {"provenance": read_json(folder / PROVENANCE_FILE)}
            fields |= _undoable(services, record)
            break
        except FileNotFoundError:
            continue  # an edit has just replaced the revision
    return ModelDetail(**fields)


def _undoable(services: Services, record: ModelRecord) -> dict[str, Any]:
    history = services.models.history(record.id)
    if history is None:
        return {}
    return {
        "can_undo": bool(history.past) and record.status.ended,
        "can_redo": bool(history.future) and record.status.ended,
        "last_edit": history.past[-1].what if history.past else None,
        "undone_edit": history.future[-1].what if history.future else None,
    }
