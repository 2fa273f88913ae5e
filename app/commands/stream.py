"""`echorooms stream`: plays a log into a running server, as a robot would."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.map import RingOption
from core.wording import counted

if TYPE_CHECKING:
    from core.sensing import RobotLog

AT_ONCE = 200
"""Scans sent together without a speed."""


def stream(
    log: Annotated[Path, typer.Argument(help="Log file or folder.")],
    url: Annotated[str, typer.Argument(help="Server, such as http://127.0.0.1:8000")],
    speed: Annotated[
        float, typer.Option(min=0, help="Times real time; 0 sends as fast as it can.")
    ] = 1.0,
    ring: RingOption = None,
    model: Annotated[
        str | None, typer.Option(help="Id of a model to localize in; else a model is made.")
    ] = None,
    leave_open: Annotated[
        bool, typer.Option("--leave-open", help="Do not finish the session at the end.")
    ] = False,
) -> None:
    """Play a log into a running server as a live session."""
    from app.commands.inputs import load_log
    from app.commands.terminal import progress_bar
    from app.live.robot_client import RobotClient
    from core.log_readers.native import header_of
    from core.progress import no_progress

    with progress_bar() as progress:
        drive = load_log(log, ring, no_progress).without_truth()
        robot = RobotClient(url, header_of(drive), "localization" if model else "mapping", model)
        sent = 0
        for records in _in_time(drive, speed):
            robot.send(records)
            sent += len(records)
            progress(sent / len(drive), f"streaming, {counted(robot.stored, 'scan')} confirmed")
    if not leave_open:
        robot.finish()
    typer.echo(f"session {robot.session['id']}: {counted(robot.stored, 'scan')} confirmed")


def _in_time(drive: RobotLog, speed: float) -> Iterator[list[dict[str, Any]]]:
    """Scans when they are due; those that are late together."""
    from core.log_readers.native_line import scan_record

    start = time.monotonic()
    waiting: list[dict[str, Any]] = []
    for scan in drive:
        if speed > 0:
            due = start + (scan.t - float(drive.t[0])) / speed
            if waiting and due > time.monotonic():
                yield waiting
                waiting = []
            time.sleep(max(0.0, due - time.monotonic()))
        elif len(waiting) >= AT_ONCE:
            yield waiting
            waiting = []
        waiting.append(scan_record(scan))
    yield waiting
