"""What the API takes and gives."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator

from app.jobs.runner import JobView
from app.storage.records import CalibrationRecord, LogRecord, ModelRecord, Status
from core.mapping.odometry_calibration import OdometryCalibration
from core.wording import is_printable

MAX_LABEL_LENGTH = 80
MAX_NAME_LENGTH = 200
MAX_REGIONS = 1000
PAPER_NEEDS_REGIONS = "the paper's offline method needs the number of regions: give regions"


def _printable(text: str) -> str:
    if not is_printable(text):
        raise ValueError("must not hold control characters")
    return text


Name = Annotated[
    str,
    Field(min_length=1, max_length=MAX_NAME_LENGTH),
    AfterValidator(_printable),
]
Label = Annotated[str, Field(max_length=MAX_LABEL_LENGTH), AfterValidator(_printable)]


class Body(BaseModel):
    """Base of what is sent: no unknown fields, text without blanks around it."""

    model_config = ConfigDict(extra="forbid", str_strip_whitespace=True, allow_inf_nan=False)


class NameBody(Body):
    """Another name."""

    name: Name


class LabelBody(Body):
    """What a person calls a node or a room; null or nothing takes the label away."""

    label: Label | None


NOT_OPTIONS = {"log_id", "name", "labels_from", "calibration"}
"""Fields of a model to be made that are not options of the modeller."""


class ModelBody(Body):
    """A model to be made from a log."""

    log_id: str = Field(max_length=64)
    name: Name | None = None
    mode: Literal["autonomous", "offline"] | None = Field(
        None, description="offline when `regions` is given, else autonomous"
    )
    regions: int | None = Field(
        None, ge=1, le=MAX_REGIONS, strict=True, description="number of regions (offline)"
    )
    method: Literal["default", "paper"] = "default"
    labels_from: str | None = Field(
        None, max_length=64, description="a model of the same home whose labels go along by overlap"
    )
    mapping: Literal["cemal", "bayes"] = "cemal"
    odometry: Literal["raw", "calibrated", "corrected"] | None = None
    calibration: Literal["robot"] | None = Field(
        None,
        description="robot: begin with what an earlier drive told of this robot's odometry (see "
        "`robot` of the log)",
    )
    resolution: float = Field(0.05, ge=0.02, le=0.5, description="metres per cell")

    def options(self) -> dict[str, Any]:
        """What `core.pipeline.modeller.ModellingOptions` takes."""
        return self.model_dump(exclude=NOT_OPTIONS, exclude_none=True)

    @model_validator(mode="after")
    def _possible(self) -> ModelBody:
        if self.mode == "autonomous" and self.regions is not None:
            raise ValueError(
                "autonomous modelling finds the number of regions itself: leave regions away "
                "or choose mode offline"
            )
        if self.mode == "offline" and self.method == "paper" and self.regions is None:
            raise ValueError(PAPER_NEEDS_REGIONS)
        return self


class ImportFields(Body):
    """The text fields beside the files of a map."""

    name: Name | None = None
    regions: int | None = Field(None, ge=1, le=MAX_REGIONS)
    method: Literal["default", "paper"] = "default"

    def options(self) -> dict[str, Any]:
        """What `core.pipeline.modeller.ModellingOptions` takes."""
        return {"mode": "offline"} | self.model_dump(exclude={"name"}, exclude_none=True)

    @model_validator(mode="after")
    def _possible(self) -> ImportFields:
        if self.method == "paper" and self.regions is None:
            raise ValueError(PAPER_NEEDS_REGIONS)
        return self


class LogIdBody(Body):
    """The log to go on with."""

    log_id: str = Field(max_length=64)


class LogSummary(BaseModel):
    """A log in the list."""

    id: str
    name: str
    created: datetime
    scans: int
    sonars: int
    duration_s: float
    distance_m: float
    size_bytes: int

    @classmethod
    def of(cls, record: LogRecord) -> LogSummary:
        """What is told of a stored log."""
        return cls(**{**vars(record), "created": moment(record.created)})


class RobotOdometry(BaseModel):
    """What is known of a robot's odometry; robots are told apart by their sonar rings."""

    model_name: str = Field(description="the model whose drive told it")
    kept: datetime
    sentences: list[str]
    calibration: dict[str, float]

    @classmethod
    def of(cls, record: CalibrationRecord) -> RobotOdometry:
        """What is told of a stored calibration."""
        found = dict(record.found)
        return cls(
            model_name=record.model_name,
            kept=moment(record.kept),
            sentences=list(OdometryCalibration(**found).sentences()),
            calibration=found,
        )


class LogDetail(LogSummary):
    """A log with its report."""

    report: dict[str, Any]
    robot: RobotOdometry | None = Field(
        None, description="what an earlier drive told of this robot's odometry"
    )


class ModelSummary(BaseModel):
    """A model in the list."""

    id: str
    name: str
    created: datetime
    updated: datetime
    status: Status
    error: str | None
    job_id: str | None
    options: dict[str, Any]
    log_ids: list[str]
    node_count: int
    room_count: int
    area_m2: float
    labels: list[str]
    size_bytes: int
    revision: int = Field(description="grows with every change; 0 until the model is made")

    @classmethod
    def of(cls, record: ModelRecord) -> ModelSummary:
        """What is told of a stored model."""
        return cls(**summary_fields(record))


class Node(BaseModel):
    """A region of the map as a place."""

    id: str
    region: int
    label: str | None
    area_m2: float
    position: tuple[float, float]
    convexity: float
    came_from: list[str] = Field([], description="earlier nodes that an edit made it from")


class Edge(BaseModel):
    """Where two nodes touch."""

    id: str
    source: str
    target: str
    doorway: tuple[float, float]
    width_m: float


class Room(BaseModel):
    """A group of adjacent nodes."""

    id: str
    room: int
    label: str | None
    nodes: list[str]


class ModelDetail(ModelSummary):
    """A model with its topology; without nodes until it is made."""

    format: str = "echorooms-topology"
    version: int = 1
    nodes: list[Node] = []
    edges: list[Edge] = []
    rooms: list[Room] = []
    provenance: dict[str, Any] = {}
    can_undo: bool = False
    can_redo: bool = False
    last_edit: str | None = Field(None, description="what undo would take back")
    undone_edit: str | None = Field(None, description="what redo would do again")


class JobDetail(BaseModel):
    """A job as it is now."""

    id: str
    kind: str
    subject_id: str
    status: Status
    progress: float = Field(ge=0, le=1)
    what: str = Field(description="what is being done")
    error: str | None
    created: datetime
    started: datetime | None
    finished: datetime | None

    @classmethod
    def of(cls, view: JobView) -> JobDetail:
        """What is told of a job."""
        record = view.record
        return cls(
            **{
                **vars(record),
                "progress": view.progress,
                "what": view.what,
                "created": moment(record.created),
                "started": None if record.started is None else moment(record.started),
                "finished": None if record.finished is None else moment(record.finished),
            }
        )


class Accepted(BaseModel):
    """Work has begun: what will be made, and the job that makes it."""

    id: str
    job_id: str


def summary_fields(record: ModelRecord) -> dict[str, Any]:
    """The fields of a model's summary."""
    fields = vars(record) | {
        "created": moment(record.created),
        "updated": moment(record.updated),
        "node_count": record.nodes,
        "room_count": record.rooms,
    }
    del fields["nodes"], fields["rooms"]
    return fields


def moment(seconds: float) -> datetime:
    """Seconds since the epoch as a time in UTC."""
    return datetime.fromtimestamp(seconds, UTC)
