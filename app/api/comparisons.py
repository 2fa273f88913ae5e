"""Two models of one home, side by side."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter
from pydantic import BaseModel, Field

from app.api.dependencies import ServicesDep
from app.errors import NotFound
from app.services import Services
from core.topology import Model

router = APIRouter(prefix="/models", tags=["models"])


class NodePair(BaseModel):
    """Two nodes that cover the same floor."""

    node: str
    other: str
    overlap: float = Field(description="intersection over union of their floors")
    moved_m: float = Field(description="distance of their positions")
    area_change_m2: float = Field(description="what the other has more")


class ParameterPair(BaseModel):
    """A parameter that differs."""

    name: str
    value: Any = None
    other_value: Any = None


class ComparisonDetail(BaseModel):
    """Where two models differ."""

    nodes: list[NodePair]
    only_here: list[str] = Field(description="ids of nodes that the other model does not have")
    only_there: list[str]
    free_overlap: float = Field(description="intersection over union of the free space")
    parameters: list[ParameterPair]


@router.get("/{model_id}/comparison/{other_id}", summary="Compare two models")
def get_comparison(model_id: str, other_id: str, services: ServicesDep) -> ComparisonDetail:
    """Nodes matched by the floor that they share, and the parameters that differ. Both models must
    be in one frame, as those of one drive are."""
    from core.topology.comparison import compare

    found = compare(_made(services, model_id), _made(services, other_id))
    return ComparisonDetail(
        nodes=[
            NodePair(
                node=pair.first,
                other=pair.second,
                overlap=round(pair.overlap, 4),
                moved_m=round(pair.moved, 3),
                area_change_m2=round(pair.area_change, 2),
            )
            for pair in found.nodes
        ],
        only_here=list(found.only_first),
        only_there=list(found.only_second),
        free_overlap=round(found.free_overlap, 4),
        parameters=[
            ParameterPair(name=name, value=value, other_value=other)
            for name, (value, other) in found.parameters.items()
        ],
    )


def _made(services: Services, model_id: str) -> Model:
    """A model that is made.

    Raises:
        NotFound, Conflict: there is none, or it is not made yet.
    """
    services.models.folder(model_id)
    model = services.models.load(model_id)
    if model is None:
        raise NotFound("model", model_id)
    return model
