"""How a model grew along the drive: every step, its decisions, and what the map looked like."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, TypeVar

from fastapi import APIRouter, Response
from fastapi import Path as Parameter
from pydantic import BaseModel, Field

from app.api.dependencies import ServicesDep
from app.errors import NotFound
from app.services import Services
from core.errors import InputError

router = APIRouter(prefix="/models", tags=["timeline"])
MOST_STEPS = 1_000_000
Point = tuple[float, float]
Found = TypeVar("Found")


class Decision(BaseModel):
    """One tentative part of the space that was left: made a region or not, and why."""

    cluster: int = Field(description="its number in the picture of the step")
    c1: float = Field(description="eq. 7 of all that was left")
    c2: float = Field(description="eq. 8 of the part and the rest")
    hidden_pairs: float = Field(description="share of point pairs of the part that see no other")
    ncut: float = Field(description="normalized cut of the part and the rest")
    cut_width_m: float
    cut: list[list[Point]] = Field(description="the cut, one polyline of world points a stretch")
    hull: list[Point] = Field(description="corners of the part's convex hull, world points")
    accepted: bool
    reason: str = Field(description="why, or why not, in words")
    region: int | None = Field(description="number of the region that it became")
    came_from: list[int] = Field(description="numbers of the regions that it was cut from")


class Moment(BaseModel):
    """One step along the drive."""

    step: int
    t: float
    distance_m: float
    pose: tuple[float, float, float]
    thresholds: dict[str, float | None] = Field(description="what the measures were held against")
    said: str = Field(description="what the step came to, in words")
    decisions: list[Decision]


@router.get("/{model_id}/timeline", summary="How the model grew along the drive")
def get_timeline(model_id: str, services: ServicesDep) -> list[Moment]:
    """The steps in order; none for a model of a map, or with the number of regions given."""
    return [Moment(**moment) for moment in _consistent(services, model_id, _moments)]


@router.get(
    "/{model_id}/timeline/{step}.png",
    summary="What a step looked like",
    response_class=Response,
    responses={200: {"content": {"image/png": {}}}},
)
def get_step_picture(
    model_id: str, step: Annotated[int, Parameter(ge=0, le=MOST_STEPS)], services: ServicesDep
) -> Response:
    """A picture as large as `grid.png`: red is `state + 4 * cluster` (state 0 unknown, 1 free, 2
    occupied), `256 * green + blue` the number of the extracted region; 0 is none."""
    content = _consistent(services, model_id, lambda folder: _picture(folder, step))
    return Response(content, media_type="image/png")


def _moments(folder: Path) -> list[dict[str, Any]]:
    from core.topology.model_folder import read_history
    from core.topology.timeline import moments

    return moments(read_history(folder))


def _picture(folder: Path, step: int) -> bytes:
    from core.mapping.map_server import read_map
    from core.topology.timeline import picture_on_map
    from core.topology.timeline_file import TIMELINE_FILE, read_step

    found = _moments(folder)
    if step >= len(found):
        raise NotFound("step", str(step))
    geometry = read_map(folder / "map.yaml", folder / "map.pgm").geometry
    return picture_on_map(read_step(folder / TIMELINE_FILE, step), found[step], geometry).png()


def _consistent(services: Services, model_id: str, read: Callable[[Path], Found]) -> Found:
    """What is read from the model's folder, read again when an edit replaces it meanwhile."""
    while True:
        folder = services.models.folder(model_id)
        try:
            found = read(folder)
        except (InputError, OSError):
            if services.models.folder(model_id) == folder:
                raise
            continue
        if services.models.folder(model_id) == folder:
            return found
