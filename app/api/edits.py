"""Edits of nodes and rooms, all of which can be undone."""

from __future__ import annotations

from typing import Annotated, Literal

from fastapi import APIRouter
from pydantic import Field

from app.api.dependencies import ServicesDep
from app.api.models import model_detail
from app.api.schemas import Body, ModelDetail
from app.storage.model_files import Edit

router = APIRouter(prefix="/models", tags=["edits"])

MOST_NODES, MOST_POINTS = 1000, 1000
FARTHEST_M = 1e6
Identifier = Annotated[str, Field(max_length=64)]
Coordinate = Annotated[float, Field(ge=-FARTHEST_M, le=FARTHEST_M)]


class MergeBody(Body):
    """Touching nodes become one; it keeps the id of the largest."""

    op: Literal["merge"]
    nodes: list[Identifier] = Field(min_length=2, max_length=MOST_NODES)


class SplitBody(Body):
    """A node becomes two, parted along a line; the larger piece keeps the id."""

    op: Literal["split"]
    node: Identifier
    line: list[tuple[Coordinate, Coordinate]] = Field(
        min_length=2, max_length=MOST_POINTS, description="world points [x, y] in metres"
    )


class MoveBody(Body):
    """A node goes to a room that it touches, or with null becomes a room of its own."""

    op: Literal["move"]
    node: Identifier
    room: Identifier | None


EditBody = Annotated[MergeBody | SplitBody | MoveBody, Field(discriminator="op")]


class RevisionBody(Body):
    """Optionally the revision that is expected: 409 when somebody has changed the model since."""

    revision: int | None = None


@router.post("/{model_id}/edits", summary="Merge, split or move nodes")
def edit_model(model_id: str, body: EditBody, services: ServicesDep) -> ModelDetail:
    """Edits the model; 422 says which geometric reason there is against it."""
    return model_detail(services, services.models.edit(model_id, _edit(body)))


@router.post("/{model_id}/undo", summary="Undo the last edit")
def undo(model_id: str, services: ServicesDep, body: RevisionBody | None = None) -> ModelDetail:
    """Takes the last edit back, a name too; 409 when there is none."""
    revision = None if body is None else body.revision
    return model_detail(services, services.models.undo(model_id, revision))


@router.post("/{model_id}/redo", summary="Redo the edit that was undone")
def redo(model_id: str, services: ServicesDep, body: RevisionBody | None = None) -> ModelDetail:
    """Does it again; 409 when nothing was undone, or another edit came after it."""
    revision = None if body is None else body.revision
    return model_detail(services, services.models.redo(model_id, revision))


def _edit(body: MergeBody | SplitBody | MoveBody) -> Edit:
    from app.storage import shape_edit

    match body:
        case MergeBody():
            return shape_edit.merge(body.nodes)
        case SplitBody():
            return shape_edit.split(body.node, body.line)
        case MoveBody():
            return shape_edit.move(body.node, body.room)
