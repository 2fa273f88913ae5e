"""`echorooms rosbridge`: sends what a ROS robot publishes to a server, as a live session."""

from __future__ import annotations

import itertools
from typing import Annotated

import typer

from app.commands.map import RingOption
from core.wording import counted


def rosbridge(
    ros: Annotated[str, typer.Argument(help="rosbridge, such as ws://robot.local:9090")],
    url: Annotated[str, typer.Argument(help="Server, such as http://127.0.0.1:8000")],
    ring: RingOption = None,
    ranges: Annotated[
        list[str] | None,
        typer.Option("--range", help="Range topic of a sonar; once for each, in ring order."),
    ] = None,
    cloud: Annotated[
        str | None, typer.Option(help="PointCloud topic of the whole ring instead.")
    ] = None,
    odometry: Annotated[str, typer.Option(help="Odometry topic.")] = "/odom",
    name: Annotated[str, typer.Option(help="What the drive is called.")] = "ROS robot",
    model: Annotated[
        str | None, typer.Option(help="Id of a model to localize in; else a model is made.")
    ] = None,
) -> None:
    """Send the sonars and the odometry of a ROS robot to a server until Ctrl-C."""
    from app.live.robot_client import RobotClient
    from app.live.ros_scans import RosScans, RosTopics
    from app.live.rosbridge import messages
    from core.errors import InputError, LogError
    from core.log_readers.native_line import FORMAT_NAME, VERSION
    from core.log_readers.ring_file import load_ring, table_of

    if ring is None:
        raise InputError("ROS messages do not tell where the sonars sit: give --ring")
    sonars, topics = load_ring(ring), RosTopics(odometry, tuple(ranges or ()), cloud)
    if cloud is None and len(topics.ranges) != len(sonars):
        raise InputError(
            f"{len(topics.ranges)} --range topics for a ring of {len(sonars)} sonars: give one for "
            "each in its order, or --cloud"
        )
    header = {"format": FORMAT_NAME, "version": VERSION, "name": name, **table_of(sonars)}
    heard = messages(ros, topics.types())
    scans, first = RosScans(sonars, topics), next(heard)
    robot = RobotClient(url, header, "localization" if model else "mapping", model)
    typer.echo(f"session {robot.session['id']}: scans from {ros} (Ctrl-C ends it)")
    try:
        for topic, message in itertools.chain((first,), heard):
            try:
                record = scans.take(topic, message)
            except LogError as error:
                typer.echo(str(error), err=True)
                continue
            if record is not None:
                robot.send([record])
    except KeyboardInterrupt:
        robot.finish()
        typer.echo(f"{counted(robot.stored, 'scan')} confirmed")
