"""The drift of a model's drive: what was found, and what a person says about it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from http import HTTPStatus
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Response
from pydantic import BaseModel, Field

from app.api.dependencies import ServicesDep
from app.api.schemas import Accepted, Body, RobotOdometry
from app.errors import NotFound, Unprocessable
from app.jobs.modelling import model_drift_again
from app.services import Services
from app.storage.drift_files import drift_report
from core.mapping.drift_edits import CLOSURE_ID, Dragged, DriftEdits, SamePlace
from core.mapping.drift_view import ODOMETRY_MAP_FILE

router = APIRouter(prefix="/models", tags=["drift"])

FARTHEST_M, LONGEST_S = 1e6, 1e12
Seconds = Annotated[float, Field(ge=-LONGEST_S, le=LONGEST_S)]
Coordinate = Annotated[float, Field(ge=-FARTHEST_M, le=FARTHEST_M)]
Heading = Annotated[float, Field(ge=-100, le=100)]
ClosureId = Annotated[str, Field(pattern=f"^{CLOSURE_ID.pattern}$", max_length=40)]


class ClosureView(BaseModel):
    """Two moments at which the robot was at one place, or was thought to be."""

    id: str
    t_source: float
    t_target: float
    score: float = Field(description="mean agreement of the two local maps, at most 1")
    accepted: bool
    reason: str = Field(description="why, or why not, in words")
    by_person: bool = False


class MapPlace(BaseModel):
    """Where the picture of a map lies in the world."""

    origin: tuple[float, float, float] = Field(description="of its lower left corner")
    resolution: float = Field(description="metres per pixel")
    shape: tuple[int, int] = Field(description="rows, columns")


class DriftDetail(BaseModel):
    """The drift of a drive, as far as it is known."""

    revision: int
    used: str = Field(description="raw, calibrated or corrected: what the map is made at")
    sentences: list[str]
    calibration: dict[str, float] | None
    closures: list[ClosureView]
    edits: dict[str, Any] = Field(description="what was said so far")
    trajectory: list[list[float]] = Field(
        description="rows of t, corrected x, y, heading, and x, y, heading of the odometry"
    )
    map: MapPlace
    odometry_map: MapPlace | None


class JudgeBody(Body):
    """A closure is right, is wrong, or is left to the program again."""

    op: Literal["accept", "reject", "forget"]
    closure: ClosureId


class SamePlaceBody(Body):
    """At these two times of the drive the robot was at the same place."""

    op: Literal["same_place"]
    t_source: Seconds
    t_target: Seconds


class DragBody(Body):
    """At this time of the drive the robot was at this place of the map."""

    op: Literal["drag"]
    t: Seconds
    x: Coordinate
    y: Coordinate
    heading: Heading | None = None


class ForgetPlaceBody(Body):
    """These two times were called the same place; they no longer are."""

    op: Literal["forget_same_place"]
    t_source: Seconds
    t_target: Seconds


class ForgetDragBody(Body):
    """The drive was dragged at this time; it no longer is."""

    op: Literal["forget_drag"]
    t: Seconds


AnyDriftEdit = JudgeBody | SamePlaceBody | DragBody | ForgetPlaceBody | ForgetDragBody
DriftEditBody = Annotated[AnyDriftEdit, Field(discriminator="op")]


@router.get("/{model_id}/drift", summary="The drift of the model's drive")
def get_drift(model_id: str, services: ServicesDep) -> DriftDetail:
    """Findings in words, closures, and the drive before and after; 404 without a drive."""
    while True:
        try:
            record = services.models.get(model_id)
            report = drift_report(services.models.folder(model_id))
            break
        except FileNotFoundError:
            continue  # an edit has just replaced the revision
    if report is None:
        raise NotFound("drive kept with the model", model_id)
    return DriftDetail(revision=record.revision, **report)


@router.get(
    "/{model_id}/drift/odometry.png",
    summary="The map at the odometry as it is",
    response_class=Response,
    responses={200: {"content": {"image/png": {}}}},
)
def get_odometry_map(model_id: str, services: ServicesDep) -> Response:
    """Like `grid.png`, before the correction."""
    try:
        content = (services.models.folder(model_id) / ODOMETRY_MAP_FILE).read_bytes()
    except FileNotFoundError as error:
        raise NotFound("map of the odometry", model_id) from error
    return Response(content, media_type="image/png")


@router.post(
    "/{model_id}/drift/edits",
    status_code=HTTPStatus.ACCEPTED,
    summary="Say something about the drift",
)
async def edit_drift(model_id: str, body: DriftEditBody, services: ServicesDep) -> Accepted:
    """Makes the model again with it, as an edit that can be undone; ids and names stay."""
    change, what = _change(body)
    job = await model_drift_again(services, model_id, change, what)
    return Accepted(id=model_id, job_id=job.id)


@router.delete(
    "/{model_id}/drift/edits",
    status_code=HTTPStatus.ACCEPTED,
    summary="Take back all that was said about the drift",
)
async def forget_drift_edits(model_id: str, services: ServicesDep) -> Accepted:
    """Makes the model again as the program alone would, as an edit that can be undone."""
    what = "left the drift to the program"
    job = await model_drift_again(services, model_id, lambda _: DriftEdits(), what)
    return Accepted(id=model_id, job_id=job.id)


@router.put("/{model_id}/drift/calibration", summary="Keep the calibration for the robot")
async def keep_calibration(model_id: str, services: ServicesDep) -> RobotOdometry:
    """What this drive told of the robot's odometry is offered for its next logs."""
    return await asyncio.to_thread(_keep, services, model_id)


@router.delete(
    "/{model_id}/drift/calibration",
    status_code=HTTPStatus.NO_CONTENT,
    summary="Forget the calibration of the robot",
)
def forget_calibration(model_id: str, services: ServicesDep) -> None:
    """Nothing is offered for the robot's next logs any more."""
    record = services.models.get(model_id)
    if record.log_ids:
        services.calibrations.forget(services.logs.ring_of(record.log_ids[0]))


def _keep(services: Services, model_id: str) -> RobotOdometry:
    record = services.models.get(model_id)
    report = drift_report(services.models.folder(model_id))
    if report is None or report["calibration"] is None or not record.log_ids:
        raise Unprocessable("the model tells nothing of a robot's odometry")
    ring = services.logs.ring_of(record.log_ids[0])
    return RobotOdometry.of(services.calibrations.keep(ring, record.name, report["calibration"]))


def _change(body: AnyDriftEdit) -> tuple[Callable[[DriftEdits], DriftEdits], str]:
    """What a body changes in what was said before, and what it says in words."""
    match body:
        case JudgeBody(op="accept"):
            return lambda said: said.accepting(body.closure), "accepted a place found again"
        case JudgeBody(op="reject"):
            return lambda said: said.rejecting(body.closure), "rejected a place found again"
        case JudgeBody():
            return lambda said: said.forgetting(body.closure), "left a closure to the program"
        case SamePlaceBody():
            same = SamePlace(body.t_source, body.t_target)
            return lambda said: said.calling_same(same), "called two places the same"
        case DragBody():
            place = Dragged(body.t, body.x, body.y, body.heading)
            return lambda said: said.dragging(place), "dragged a stretch of the drive"
        case ForgetPlaceBody():
            places = SamePlace(body.t_source, body.t_target)
            return lambda said: said.parting(places), "no longer called two places the same"
        case ForgetDragBody():
            return lambda said: said.releasing(body.t), "let a dragged stretch go"
