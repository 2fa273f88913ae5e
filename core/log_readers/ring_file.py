"""The sonar ring as a table: in a native header, in a `log.yaml`, or in a file of its own.

robot: {radius: 0.26}
units: {length: mm, angle: deg}     # m and rad unless said
beam_width: 20                      # for all sonars that do not say otherwise; also min_range, max_range
sonars:
  - {x: 69, y: 136, heading: 90}
  - [114, 119, 50]                  # x, y, heading
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from core.errors import InputError, LogError, TooLargeError
from core.log_readers.limits import DEFAULT_LIMITS, ReadLimits
from core.log_readers.safe_yaml import describe, load_yaml
from core.log_readers.units import ANGLE_UNITS, LENGTH_UNITS
from core.sensing.ring import RING_PRESETS, Sonar, SonarRing

_STRICT = ConfigDict(strict=True, extra="ignore", allow_inf_nan=False)


def _row_as_fields(value: Any) -> Any:
    """A sonar given as a row of numbers, as the fields they stand for."""
    if isinstance(value, list):
        return dict(zip(("x", "y", "heading"), value, strict=False))
    return value


class _SonarEntry(BaseModel):
    model_config = _STRICT
    x: float
    y: float
    heading: float
    beam_width: float | None = None
    min_range: float | None = None
    max_range: float | None = None


class _Robot(BaseModel):
    model_config = _STRICT
    radius: float


class _RingUnits(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid")
    length: Literal["m", "cm", "mm"] = "m"
    angle: Literal["rad", "deg"] = "rad"


class _RingTable(BaseModel):
    model_config = _STRICT
    robot: _Robot
    units: _RingUnits = _RingUnits()
    beam_width: float | None = None
    min_range: float | None = None
    max_range: float | None = None
    sonars: list[Annotated[_SonarEntry, BeforeValidator(_row_as_fields)]] = Field(min_length=1)


def load_ring(name_or_path: str, limits: ReadLimits = DEFAULT_LIMITS) -> SonarRing:
    """The ring with that name, or the one in a YAML or JSON file.

    Raises:
        InputError: neither a preset nor a file that describes a ring.
    """
    if name_or_path in RING_PRESETS:
        return RING_PRESETS[name_or_path]
    path = Path(name_or_path)
    try:
        if not path.is_file():
            raise InputError(
                f"ring {name_or_path!r} is neither a file nor one of {', '.join(RING_PRESETS)}"
            )
        with path.open("rb") as file:
            data = file.read(limits.max_yaml_bytes + 1)
    except (OSError, ValueError) as error:
        raise InputError(f"ring file {path.name}: {error}") from error
    return ring_from_bytes(data, path.name, limits)


def ring_from_bytes(data: bytes, source: str, limits: ReadLimits = DEFAULT_LIMITS) -> SonarRing:
    """The ring that a YAML or JSON text describes.

    Raises:
        LogError: it does not, and why.
    """
    table = load_yaml(data, source, limits)
    try:
        return parse_ring(table, limits)
    except LogError as error:
        raise LogError(str(error), source) from error


def parse_ring(table: Any, limits: ReadLimits = DEFAULT_LIMITS) -> SonarRing:
    """The ring that a table (see above) describes.

    Raises:
        LogError: a field is missing, is no number or cannot be; the error has no source.
        TooLargeError: more sonars than the limit.
    """
    if not isinstance(table, dict):
        raise LogError("a ring is a table with `robot` and `sonars`")
    sonars = table.get("sonars")
    if isinstance(sonars, list) and len(sonars) > limits.max_sonars:
        raise TooLargeError(f"{len(sonars)} sonars; a ring has at most {limits.max_sonars}")
    try:
        checked = _RingTable.model_validate(table)
    except ValidationError as error:
        raise LogError(describe(error)) from error
    metre, radian = LENGTH_UNITS[checked.units.length], ANGLE_UNITS[checked.units.angle]
    radius = checked.robot.radius * metre
    if not 0 < radius <= limits.max_mount_m:
        raise LogError(f"robot.radius {radius:g} m must be between 0 and {limits.max_mount_m:g} m")
    return SonarRing(
        tuple(
            _sonar(i, entry, checked, metre, radian, limits)
            for i, entry in enumerate(checked.sonars)
        ),
        radius,
    )


def table_of(ring: SonarRing) -> dict[str, Any]:
    """The table that `parse_ring` reads as `ring`."""
    return {
        "robot": {"radius": ring.robot_radius},
        "sonars": [
            {
                "x": s.x,
                "y": s.y,
                "heading": s.heading,
                "beam_width": s.beam_width,
                "min_range": s.min_range,
                "max_range": s.max_range,
            }
            for s in ring.sonars
        ],
    }


def write_ring(ring: SonarRing, path: Path) -> None:
    """Writes a ring file (JSON, which is YAML too)."""
    path.write_text(json.dumps(table_of(ring), indent=1) + "\n", encoding="utf-8")


def _sonar(
    index: int,
    entry: _SonarEntry,
    ring: _RingTable,
    metre: float,
    radian: float,
    limits: ReadLimits,
) -> Sonar:
    where = f"sonars[{index}]"

    def field(name: str) -> float:
        value = getattr(entry, name)
        value = getattr(ring, name) if value is None else value
        if value is None:
            raise LogError(f"{where}.{name} is missing")
        return float(value)

    x, y = entry.x * metre, entry.y * metre
    heading, beam = entry.heading * radian, field("beam_width") * radian
    nearest, farthest = field("min_range") * metre, field("max_range") * metre
    if max(abs(x), abs(y)) > limits.max_mount_m:
        raise LogError(
            f"{where} sits {max(abs(x), abs(y)):g} m from the robot's centre (metres? at most "
            f"{limits.max_mount_m:g})"
        )
    if abs(heading) > 4 * math.pi:
        raise LogError(f"{where}.heading {heading:g} is no angle in radians")
    if not 0 < beam <= 2 * math.pi:
        raise LogError(f"{where}.beam_width {beam:g} must be between 0 and 2 pi radians")
    if not 0 <= nearest < farthest <= limits.max_sonar_range_m:
        raise LogError(
            f"{where}: min_range {nearest:g} and max_range {farthest:g} must be rising, in metres "
            f"and at most {limits.max_sonar_range_m:g}"
        )
    return Sonar(x, y, heading, beam, nearest, farthest)
