"""What a simulated robot is told: the order that makes it, and the commands while it drives."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, TypeAdapter, model_validator

from core.sensing.ring import RING_PRESETS

HOMES = ("paper", "mirrored", "corridor", "hall", "office")
"""The homes that are not made from a number (`core.simulation` knows them too, but is heavy)."""
HOME_PATTERN = rf"^({'|'.join(HOMES)}|random-\d{{1,9}})$"
ODOMETRY = ("none", "calibrated", "bad")
FASTEST_MPS, FASTEST_RADPS = 0.4, 1.2
"""What a command may ask of the robot: a little above its own cruise."""
MOST_SPEED = 10.0
Metres = Annotated[float, Field(ge=-1e3, le=1e3)]
Radians = Annotated[float, Field(ge=-7, le=7)]
Speed = Annotated[float, Field(ge=1, le=MOST_SPEED, description="times real time")]
Thing = Annotated[str, Field(max_length=60)]


def _known_ring(name: str) -> str:
    if name not in RING_PRESETS:
        raise ValueError(f"there is no ring {name!r}; there are {', '.join(RING_PRESETS)}")
    return name


class _Told(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class RobotOrder(_Told):
    """A simulated robot to be made."""

    home: str = Field(default="paper", pattern=HOME_PATTERN, description="paper, random-17, …")
    ring: Annotated[str, AfterValidator(_known_ring)] = Field(
        default="paper-12", description="name of a sonar ring"
    )
    odometry: Literal["none", "calibrated", "bad"] = "calibrated"
    seed: int = Field(default=0, ge=0, le=2**31, description="start, noise and goals")
    mode: Literal["tour", "drive"] = Field(
        default="tour", description="tours by itself, or stands until it is told to move"
    )
    model_id: str | None = Field(
        default=None, max_length=64, description="where to localize; without it the robot maps"
    )
    speed: Speed = 1.0
    evaluation: bool = Field(
        default=False,
        description="send the true poses too; they are kept and never used to make a model",
    )


class Drive(_Told):
    """Drive with this speed and turn rate; it holds for a second, then the robot stops."""

    type: Literal["drive"]
    speed: float = Field(ge=-FASTEST_MPS, le=FASTEST_MPS, description="m/s")
    turn_rate: float = Field(ge=-FASTEST_RADPS, le=FASTEST_RADPS, description="rad/s, left is +")


class GoTo(_Told):
    """Find a way to a place in the home's frame."""

    type: Literal["goal"]
    x: Metres
    y: Metres


class Tour(_Told):
    """Drive by itself: everywhere while it maps, from room to room while it localizes."""

    type: Literal["tour"]


class Stop(_Told):
    """Stand still."""

    type: Literal["stop"]


class Place(_Told):
    """Be carried elsewhere; the odometry does not notice. Without a place: anywhere far away."""

    type: Literal["place"]
    x: Metres | None = None
    y: Metres | None = None
    heading: Radians | None = None

    @model_validator(mode="after")
    def _whole(self) -> Place:
        if (self.x is None) != (self.y is None):
            raise ValueError("give both x and y, or neither")
        return self


class Door(_Told):
    """Shut or open a door."""

    type: Literal["door"]
    name: Thing
    shut: bool


class Move(_Told):
    """Push a piece of furniture so that its middle is at a place, or as near as there is room."""

    type: Literal["furniture"]
    name: Thing
    x: Metres
    y: Metres


class Hurry(_Told):
    """Live through time faster or slower."""

    type: Literal["speed"]
    speed: Speed


class Localize(_Told):
    """Finish mapping; as soon as the model is made, look for itself in it."""

    type: Literal["localize"]


Command = Annotated[
    Drive | GoTo | Tour | Stop | Place | Door | Move | Hurry | Localize,
    Field(discriminator="type"),
]
COMMAND: TypeAdapter[Command] = TypeAdapter(Command)
