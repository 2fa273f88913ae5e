"""`echorooms bridge`: turns what a microcontroller prints on a serial port into a live session."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.map import RingOption
from core.wording import counted

if TYPE_CHECKING:
    from app.live.serial_lines import SerialLines

BAUD = 115_200
WAIT_S = 1.0
"""Before a port that was pulled is looked for again."""
MOST_BAD_LINES = 20
"""Lines in a row that are none, after which something else must be wrong."""


def bridge(
    serial_port: Annotated[str, typer.Argument(help="Serial port, such as /dev/ttyUSB0 or COM3.")],
    url: Annotated[str, typer.Argument(help="Server, such as http://127.0.0.1:8000")],
    ring: RingOption = None,
    baud: Annotated[int, typer.Option(min=300, help="Bits a second.")] = BAUD,
    name: Annotated[str, typer.Option(help="What the drive is called.")] = "sonar ring",
    model: Annotated[
        str | None, typer.Option(help="Id of a model to localize in; else a model is made.")
    ] = None,
) -> None:
    """Send the scans of a sonar ring on a serial port to a server until Ctrl-C."""
    from app.live.robot_client import RobotClient
    from app.live.serial_lines import SerialLines
    from core.errors import InputError
    from core.log_readers.native_line import FORMAT_NAME, VERSION
    from core.log_readers.ring_file import load_ring, table_of

    if ring is None:
        raise InputError("a serial line does not tell where the sonars sit: give --ring")
    sonars = load_ring(ring)
    header = {"format": FORMAT_NAME, "version": VERSION, "name": name, **table_of(sonars)}
    robot = RobotClient(url, header, "localization" if model else "mapping", model)
    typer.echo(f"session {robot.session['id']}: scans from {serial_port} (Ctrl-C ends it)")
    try:
        for record in _records(serial_port, baud, SerialLines(len(sonars))):
            robot.send([record])
    except KeyboardInterrupt:
        robot.finish()
        typer.echo(f"{counted(robot.stored, 'scan')} confirmed")


def _records(port: str, baud: int, lines: SerialLines) -> Iterator[dict[str, Any]]:
    """The scans of a port; it may be pulled and plugged in again."""
    from core.errors import InputError, LogError

    bad = 0
    for line in _lines_of(port, baud):
        try:
            record = lines.record(line)
        except LogError as error:
            bad += 1
            if bad == MOST_BAD_LINES:
                raise InputError(
                    f"{port}: {error}. Is the sketch the right one, and --baud {baud} its speed?"
                ) from error
            continue
        bad = 0
        yield record


def _lines_of(port: str, baud: int) -> Iterator[bytes]:
    import serial

    from app.live.serial_lines import LONGEST_LINE
    from core.errors import InputError

    opened = False
    while True:
        try:
            with serial.Serial(port, baud, timeout=WAIT_S) as device:
                opened = True
                device.readline()  # the middle of a line, most likely
                half = b""
                while True:
                    half += device.readline(LONGEST_LINE)
                    if half.endswith(b"\n") or len(half) >= LONGEST_LINE:
                        yield half
                        half = b""
        except serial.SerialException as error:
            if not opened:
                raise InputError(f"{port} cannot be opened: {error}") from error
            typer.echo(f"{port} is gone; waiting for it", err=True)
            time.sleep(WAIT_S)
