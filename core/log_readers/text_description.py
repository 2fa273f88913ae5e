"""`log.yaml`: what the columns of plain text files mean.

    name: corridor
    ring: p3dx-front-8            # a preset, a ring file beside this one, or the table of ring_file.py
    files:
      - path: poses.txt
        columns: {t: 0, x: 1, y: 2, heading: 3}        # numbers from 0, or names from the header row
        units: {time: ms, position: mm, heading: 0.1deg}
      - path: sonar.txt
        columns: {t: 0, ranges: [1, 2, 3, 4, 5, 6, 7, 8]}
        units: {time: ms, range: mm}
        no_echo: 5110

One file may hold everything. Where poses and ranges are apart, every row of ranges becomes a scan at the
pose interpolated for its time. Several files of ranges (`sonars` says which) are merged by time.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, model_validator

from core.errors import LogError
from core.log_readers.limits import ReadLimits
from core.log_readers.safe_yaml import describe, load_yaml
from core.log_readers.units import ANGLE_UNITS, LENGTH_UNITS, TIME_UNITS

MAX_FILES = 300
MAX_SKIPPED_ROWS = 10_000
NAMED_DELIMITERS = {"comma": ",", "semicolon": ";", "tab": "\t", "space": " "}

_STRICT = ConfigDict(strict=True, extra="forbid", allow_inf_nan=False, frozen=True)
Column = Annotated[int, Field(ge=0, lt=10_000)] | Annotated[str, Field(max_length=200)]
Factor = Annotated[float, Field(gt=0)]


def _as_list(value: Any) -> Any:
    return value if isinstance(value, list) else [value]


def _without_space(value: Any) -> Any:
    return value.replace(" ", "") if isinstance(value, str) else value


class Columns(BaseModel):
    """Where the quantities stand: columns by number from 0 or by name."""

    model_config = _STRICT
    t: Column
    x: Column | None = None
    y: Column | None = None
    heading: Column | None = None
    truth_x: Column | None = None
    truth_y: Column | None = None
    truth_heading: Column | None = None
    ranges: list[Column] = Field(default=[], max_length=10_000)

    @model_validator(mode="after")
    def _whole_poses(self) -> Columns:
        for name, pose in (("x, y and heading", self.pose), ("truth_x, ...", self.truth)):
            if 0 < sum(column is not None for column in pose) < 3:
                raise ValueError(f"{name} must be given together")
        if not self.ranges and self.x is None and self.truth_x is None:
            raise ValueError("none of x, y, heading, ranges, truth_x, ... is given")
        return self

    @property
    def pose(self) -> tuple[Column | None, Column | None, Column | None]:
        """The columns of the odometry."""
        return self.x, self.y, self.heading

    @property
    def truth(self) -> tuple[Column | None, Column | None, Column | None]:
        """The columns of the true pose."""
        return self.truth_x, self.truth_y, self.truth_heading


class Units(BaseModel):
    """Units by name, or as a factor to SI."""

    model_config = _STRICT
    time: Literal["s", "ms", "us", "ns"] | Factor = "s"
    position: Literal["m", "cm", "mm"] | Factor = "m"
    heading: Annotated[
        Literal["rad", "deg", "0.1deg"] | Factor, BeforeValidator(_without_space)
    ] = "rad"
    range: Literal["m", "cm", "mm"] | Factor = "m"

    @property
    def second(self) -> float:
        """Seconds in a unit of time."""
        return TIME_UNITS[self.time] if isinstance(self.time, str) else self.time

    @property
    def position_metre(self) -> float:
        """Metres in a unit of position."""
        return LENGTH_UNITS[self.position] if isinstance(self.position, str) else self.position

    @property
    def radian(self) -> float:
        """Radians in a unit of heading."""
        return ANGLE_UNITS[self.heading] if isinstance(self.heading, str) else self.heading

    @property
    def range_metre(self) -> float:
        """Metres in a unit of range."""
        return LENGTH_UNITS[self.range] if isinstance(self.range, str) else self.range


class TextFile(BaseModel):
    """One file of rows.

    `no_echo`, `too_close`, `no_echo_from` (this value and all above are no echo) are in the unit of the
    file. A blank field, NaN and infinity are no echo too. `time_offset` (s) is added to the times.
    """

    model_config = _STRICT
    path: str = Field(min_length=1, max_length=500)
    columns: Columns
    units: Units = Units()
    delimiter: str = Field(default="auto", min_length=1, max_length=12)
    decimal: Literal[".", ","] = "."
    header: bool | None = None
    skip_rows: int = Field(default=0, ge=0, le=MAX_SKIPPED_ROWS)
    comment: str = Field(default="#", max_length=5)
    sonars: list[Annotated[int, Field(ge=0)]] | None = None
    no_echo: Annotated[list[float], BeforeValidator(_as_list)] = []
    no_echo_from: float | None = None
    too_close: Annotated[list[float], BeforeValidator(_as_list)] = []
    time_offset: float = 0.0

    @property
    def all_columns(self) -> list[Column]:
        """Every column that is read: t, pose, truth, ranges."""
        given = (self.columns.t, *self.columns.pose, *self.columns.truth, *self.columns.ranges)
        return [column for column in given if column is not None]

    @property
    def has_header(self) -> bool:
        """Whether the first row names the columns: as said, or because columns are named."""
        named = any(isinstance(column, str) for column in self.all_columns)
        return named if self.header is None else self.header


class TextDescription(BaseModel):
    """A whole `log.yaml`."""

    model_config = _STRICT
    format: Literal["echorooms-text"] = "echorooms-text"
    version: Literal[1] = 1
    name: str = Field(default="", max_length=200)
    ring: str | dict[str, Any] | None = None
    files: list[TextFile] = Field(min_length=1, max_length=MAX_FILES)

    @model_validator(mode="after")
    def _one_of_each(self) -> TextDescription:
        if not any(file.columns.ranges for file in self.files):
            raise ValueError("no file has `ranges`")
        for what, count in (
            ("x, y, heading", sum(file.columns.x is not None for file in self.files)),
            ("truth_x, ...", sum(file.columns.truth_x is not None for file in self.files)),
        ):
            if count > 1 or (count == 0 and what[0] == "x"):
                raise ValueError(f"{count} files have {what}; it must be one")
        return self


def parse_description(data: bytes, source: str, limits: ReadLimits) -> TextDescription:
    """Reads a `log.yaml`.

    Raises:
        LogError: what is wrong in it.
    """
    content = load_yaml(data, source, limits)
    if not isinstance(content, dict):
        raise LogError("must be a table with `files`", source)
    try:
        return TextDescription.model_validate(content)
    except ValidationError as error:
        raise LogError(describe(error), source) from error
