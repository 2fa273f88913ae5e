"""Simulated robots: made, told where to drive, carried elsewhere, watched over `/api/live`."""

from __future__ import annotations

from datetime import datetime
from http import HTTPStatus
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Body, Depends
from pydantic import BaseModel, Field
from starlette.requests import HTTPConnection

from app.api.schemas import moment
from app.robots.fleet import RobotFleet
from app.robots.order import HOMES, ODOMETRY, Command, RobotOrder
from app.robots.robot import Robot
from core.sensing.ring import RING_PRESETS

router = APIRouter(prefix="/robots", tags=["simulated robots"])
Point = tuple[float, float]


def get_fleet(connection: HTTPConnection) -> RobotFleet:
    """The simulated robots of the app that got the request."""
    fleet: RobotFleet = connection.app.state.robots
    return fleet


FleetDep = Annotated[RobotFleet, Depends(get_fleet)]


class Choices(BaseModel):
    """What a simulated robot can be made of."""

    homes: list[str]
    random_homes: str = "random-N, for any number N"
    rings: list[str]
    odometry: list[str]


class DoorState(BaseModel):
    """A door that can be shut."""

    name: str
    rooms: tuple[str, str]
    shut: bool
    position: Point


class FurniturePlace(BaseModel):
    """A piece of furniture; `position`: its middle, metres in the home's frame."""

    name: str
    position: Point
    size: Point


class RobotDetail(BaseModel):
    """A simulated robot as it is now."""

    id: str
    simulated: Literal[True] = True
    home: str
    ring: str
    odometry: str
    seed: int
    created: datetime
    ended: str | None = Field(description="why it drives no more; null while it does")
    session_id: str = Field(description="the live session that it feeds; another after `localize`")
    model_id: str
    mode: str = Field(description="mapping or localization")
    task: str = Field(description="tour, goal, drive, stand, or waiting for its model")
    speed: float
    t: float = Field(description="simulated seconds since it was made")
    distance_m: float
    toured: bool = Field(description="whether a tour has come near everything")
    blocked: bool = Field(description="whether it has just run into something")
    stored: int = Field(description="scans of this session that the server has confirmed")
    waiting: int = Field(description="scans that it has not")
    doors: list[DoorState]
    furniture: list[FurniturePlace]

    @classmethod
    def of(cls, robot: Robot) -> RobotDetail:
        """What is told of a robot."""
        order: dict[str, Any] = robot.order.model_dump(include={"home", "ring", "odometry", "seed"})
        own: dict[str, Any] = {
            "id": robot.id,
            "created": moment(robot.created),
            "ended": robot.ended,
        }
        return cls(**order, **own, **robot.status)


@router.post("", status_code=HTTPStatus.CREATED, summary="Make a simulated robot")
async def create(order: RobotOrder, fleet: FleetDep) -> RobotDetail:
    """Begins a live session and feeds it as a real robot would; answers once it is begun."""
    return RobotDetail.of(await fleet.create(order))


@router.get("", summary="List simulated robots")
async def list_robots(fleet: FleetDep) -> list[RobotDetail]:
    """Those that drive and the last that did, the newest first."""
    return [RobotDetail.of(robot) for robot in fleet.robots()]


@router.get("/choices", summary="Homes, rings and odometry to choose from")
async def choices() -> Choices:
    """What `POST /api/robots` takes."""
    return Choices(homes=list(HOMES), rings=list(RING_PRESETS), odometry=list(ODOMETRY))


@router.get("/{robot_id}", summary="One simulated robot")
async def get_robot(robot_id: str, fleet: FleetDep) -> RobotDetail:
    """What it does and how far it is; doors and furniture of its home as they are now."""
    return RobotDetail.of(fleet.robot(robot_id))


@router.post("/{robot_id}/commands", summary="Tell a simulated robot something")
async def command(robot_id: str, told: Annotated[Command, Body()], fleet: FleetDep) -> RobotDetail:
    """`drive`, `goal`, `tour`, `stop`, `place`, `door`, `furniture`, `speed` or `localize`.

    Places are in the home's frame, in which its map is drawn.
    """
    return RobotDetail.of(await fleet.tell(robot_id, told))


@router.delete("/{robot_id}", status_code=HTTPStatus.NO_CONTENT, summary="Stop a simulated robot")
async def remove(robot_id: str, fleet: FleetDep) -> None:
    """Takes the robot away and finishes its session: a log with its model is left."""
    await fleet.remove(robot_id)
