"""What a page and its 3D view tell each other over `WS /view/{id}/events?tab=TOKEN`, as JSON."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter


class _Message(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Select(_Message):
    """Page -> view: mark this node (null: none), and others beside it."""

    type: Literal["select"]
    node: str | None = Field(max_length=200)
    others: tuple[Annotated[str, Field(max_length=200)], ...] = Field((), max_length=1000)


class Layers(_Message):
    """Page -> view: show or hide layers in this tab."""

    type: Literal["layers"]
    layers: dict[str, bool] = Field(max_length=40)


class Camera(_Message):
    """Page -> view: go to the 3D or the top view, or show everything again (`fit`)."""

    type: Literal["camera"]
    view: Literal["3d", "top", "fit"]


class Measure(_Message):
    """Page -> view: start or end measuring; starting again clears the last measurement."""

    type: Literal["measure"]
    on: bool


class Theme(_Message):
    """Page -> view: light or dark."""

    type: Literal["theme"]
    theme: Literal["light", "dark"]


class Viewport(_Message):
    """Page -> view: size of the 3D view in CSS pixels."""

    type: Literal["viewport"]
    width: float = Field(gt=0, lt=20_000, allow_inf_nan=False)
    height: float = Field(gt=0, lt=20_000, allow_inf_nan=False)


Metres = Annotated[float, Field(ge=-1e6, le=1e6, allow_inf_nan=False)]
Radians = Annotated[float, Field(ge=-1e3, le=1e3, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]
NodeId = Annotated[str, Field(max_length=200)]


class Belief(_Message):
    """What a step of a localization believes; `template` is in the robot's frame at `pose`."""

    probabilities: dict[NodeId, Share] = Field(max_length=2000)
    unknown: Share
    pose: tuple[Metres, Metres, Radians]
    template: tuple[tuple[Metres, Metres], ...] = Field((), max_length=2000)
    candidates: dict[NodeId, tuple[Metres, Metres, Radians, Share]] = Field(
        default_factory=dict, max_length=2000
    )
    """x, y, heading and score by node id."""


class Playback(_Message):
    """Page -> view: show the belief of a step (null: none any more)."""

    type: Literal["playback"]
    belief: Belief | None


class Moment(_Message):
    """Page -> view: show the model as it was at a step of its drive (null: as it is)."""

    type: Literal["moment"]
    step: int | None = Field(ge=0, le=1_000_000)
    decision: int | None = Field(None, ge=0, le=10_000)
    """Which tentative part of that step is looked at."""


class Drift(_Message):
    """Page -> view: show the drive before and after its correction instead of the model, or end it."""

    type: Literal["drift"]
    on: bool
    share: Share = 1.0
    """0: at the odometry, 1: corrected, between: on the way."""
    closure: str | None = Field(None, max_length=64)
    """Id of the closure that is looked at."""
    places: tuple[Annotated[float, Field(allow_inf_nan=False)], ...] = Field((), max_length=2)
    """Times (s) of places of the drive that are marked."""


class Beside(_Message):
    """Page -> view: another model is shown beside this one, with the same camera (null: none)."""

    type: Literal["beside"]
    model: str | None = Field(max_length=200)


class Live(_Message):
    """Page -> view: how a live session is shown; `at` is the moment (s), null: now."""

    type: Literal["live"]
    follow: bool
    paused: bool
    at: float | None = Field(allow_inf_nan=False)


class Pick(_Message):
    """Page -> view: the next click is to be a place on the floor (or no more)."""

    type: Literal["pick"]
    on: bool


FromPage = Annotated[
    Select
    | Layers
    | Camera
    | Measure
    | Theme
    | Viewport
    | Playback
    | Moment
    | Drift
    | Beside
    | Live
    | Pick,
    Field(discriminator="type"),
]
FROM_PAGE: TypeAdapter[FromPage] = TypeAdapter(FromPage)


class Hello(_Message):
    """View -> page, first: what is drawn. `colours` are `#rrggbb` by node id."""

    type: Literal["hello"] = "hello"
    model: str
    layers: dict[str, bool]
    colours: dict[str, str]
    labels: dict[str, str | None]
    selected: str | None


class Ready(_Message):
    """View -> page: the browser's 3D view is connected and set up (or has gone)."""

    type: Literal["ready"] = "ready"
    connected: bool


class Selected(_Message):
    """View -> page: a node was clicked in 3D (null: beside all of them)."""

    type: Literal["selected"] = "selected"
    node: str | None


class Labels(_Message):
    """View -> page: somebody named nodes; all labels and colours as they are now."""

    type: Literal["labels"] = "labels"
    labels: dict[str, str | None]
    colours: dict[str, str]


class ModelChanged(_Message):
    """View -> page: the model has other nodes now; ask the API again."""

    type: Literal["model_changed"] = "model_changed"


class ModelDeleted(_Message):
    """View -> page: the model is gone."""

    type: Literal["model_deleted"] = "model_deleted"


class Measured(_Message):
    """View -> page: the points clicked so far and, of two, their distance in metres."""

    type: Literal["measured"] = "measured"
    points: tuple[tuple[float, float], ...]
    distance_m: float | None


class Picked(_Message):
    """View -> page: the place on the floor (m) that was clicked."""

    type: Literal["picked"] = "picked"
    x: float
    y: float


class Track(_Message):
    """View -> page: it shows a live session; from when to when it can be looked at (s)."""

    type: Literal["track"] = "track"
    first_t: float | None
    last_t: float | None


class Pointed(_Message):
    """View -> page: a click on the floor while the drift is shown; `t` (s): the drive's nearest place,
    `away_m` from it."""

    type: Literal["pointed"] = "pointed"
    point: tuple[float, float]
    t: float
    away_m: float


class CameraView(_Message):
    """View -> page: which of the standard views the camera was sent to."""

    type: Literal["camera"] = "camera"
    view: Literal["3d", "top"]


ToPage = (
    Hello
    | Ready
    | Selected
    | Labels
    | ModelChanged
    | ModelDeleted
    | Measured
    | Pointed
    | CameraView
    | Picked
    | Track
)
