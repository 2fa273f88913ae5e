"""Lines of a microcontroller become scans, whatever happens to board and cable."""

from __future__ import annotations

import os
import pty
import threading
from collections.abc import Iterator

import pytest

from app.commands.bridge import MOST_BAD_LINES, _records
from app.live.serial_lines import RESTART_S, SerialLines
from core.errors import InputError, LogError

LINE = b"12250;1000;-500;1571;1020;0;350"


def summed(line: bytes) -> bytes:
    total = 0
    for byte in line:
        total ^= byte
    return line + f"*{total:02X}\r\n".encode()


def test_millimetres_and_milliseconds_become_metres_and_seconds() -> None:
    assert SerialLines(3).record(summed(LINE)) == {
        "t": 12.25,
        "odom": [1.0, -0.5, 1.571],
        "ranges": [1.02, None, 0.35],
    }


def test_the_check_sum_may_be_left_out_but_not_be_wrong() -> None:
    assert SerialLines(3).record(LINE + b"\n")["t"] == 12.25
    with pytest.raises(LogError, match="check sum"):
        SerialLines(3).record(LINE + b"*00\n")


@pytest.mark.parametrize(
    "line", [b"", b"1000;1", b"hello", b"\xff\xfe;1;2;3;4", b"1;2;3;4;nan;5;6", LINE + b";99"]
)
def test_what_is_no_whole_line_is_said(line: bytes) -> None:
    with pytest.raises(LogError):
        SerialLines(3).record(line)


def test_time_and_pose_go_on_after_a_reset_of_the_board() -> None:
    lines = SerialLines(1)
    lines.record(b"60000;1000;0;0;500")
    again = lines.record(b"100;0;0;0;500")
    assert again["t"] == pytest.approx(60 + RESTART_S)
    assert again["odom"] == [1.0, 0.0, 0.0]
    on = lines.record(b"350;100;0;0;500")
    assert on["t"] == pytest.approx(60.25 + RESTART_S)
    assert on["odom"] == [1.1, 0.0, 0.0]


def test_millis_that_roll_over_are_no_reset() -> None:
    lines = SerialLines(1)
    before = lines.record(b"4294967196;0;0;0;500")["t"]
    assert lines.record(b"150;10;0;0;500")["t"] - before == pytest.approx(0.25, abs=1e-3)


@pytest.fixture
def board() -> Iterator[tuple[int, str]]:
    """A pseudo terminal: where the board writes, and the name of the port."""
    master, slave = pty.openpty()
    yield master, os.ttyname(slave)
    os.close(master)
    os.close(slave)


def prints(master: int, data: bytes) -> None:
    """The board prints a moment later, when the port is open."""
    threading.Timer(0.3, os.write, (master, data)).start()


def test_scans_come_off_a_port_and_half_lines_do_not_harm(board: tuple[int, str]) -> None:
    master, port = board
    records = _records(port, 115200, SerialLines(3))
    prints(master, LINE[4:] + b"\n" + summed(LINE) + b"garbage\n" + b"12500;1000;-500;15")
    assert next(records)["t"] == 12.25
    prints(master, b"71;1020;0;350\n")
    assert next(records) == {"t": 12.5, "odom": [1.0, -0.5, 1.571], "ranges": [1.02, None, 0.35]}
    records.close()


def test_a_port_that_speaks_something_else_is_said(board: tuple[int, str]) -> None:
    master, port = board
    prints(master, b"$GPGGA\n" * (MOST_BAD_LINES + 1))
    with pytest.raises(InputError, match="the right one, and --baud 9600"):
        next(_records(port, 9600, SerialLines(3)))


def test_a_port_that_is_not_there_is_said() -> None:
    with pytest.raises(InputError, match="cannot be opened"):
        next(_records("/dev/no-such-port", 9600, SerialLines(3)))
