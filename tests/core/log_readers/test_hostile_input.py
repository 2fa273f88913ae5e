"""Input that wants to harm: one clear line, soon, and little memory."""

from __future__ import annotations

import gzip
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from core.errors import LogError, TooLargeError
from core.log_readers import read_log
from core.log_readers.limits import ReadLimits

Write = Callable[..., Path]
SMALL = ReadLimits(max_bytes=20_000, max_line_bytes=5_000, max_lines=100, max_readings=120)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "the file is empty"),
        (gzip.compress(b"", mtime=0), "the file is empty"),
        (b"\x89PNG\r\n\x1a\n" + bytes(50), "is a PNG image, not a robot log"),
        (b"\x1f\x8b\x08", "the gzip file ends early"),
        (b"PK\x03\x04" + bytes(50), "the zip is cut or damaged"),
        (b"#ROSBAG V2.0\n", "is a ROS 1 bag"),
        (bytes(range(256)) * 10, "is not a robot log that this program knows"),
        (b"t,x,y\n1,2,3\n", "is text, but no native log"),
        (b"{" * 5000, "nested too deep|not a line of JSON"),
        (b"image: map.pgm\nresolution: 0.05\n", "is text"),
    ],
)
def test_what_is_no_log_is_told_for_what_it_is(
    content: bytes, message: str, tmp_path: Path
) -> None:
    path = tmp_path / "log.jsonl"
    path.write_bytes(content)
    with pytest.raises(LogError, match=f"^log.jsonl.*({message})"):
        read_log(path)


def test_a_path_that_is_no_file_is_an_error(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(LogError, match="pipe: neither a file nor a folder"):
        read_log(tmp_path / "pipe")
    with pytest.raises(LogError, match="nothing: no such file or folder"):
        read_log(tmp_path / "nothing")
    with pytest.raises(LogError, match=r"the folder has no log.yaml"):
        read_log(tmp_path)


def test_half_a_gzip_is_refused_at_the_line_where_it_ends(
    header: Any, scans: Any, write_lines: Write
) -> None:
    path = write_lines(header, *scans)
    packed = gzip.compress(path.read_bytes())
    path.write_bytes(packed[: len(packed) // 2])
    with pytest.raises(LogError, match="ends early: copy it again") as caught:
        read_log(path)
    assert caught.value.line is not None


def test_a_gzip_with_a_wrong_byte_is_damaged(header: Any, scans: Any, write_lines: Write) -> None:
    path = write_lines(header, *scans)
    packed = bytearray(gzip.compress(path.read_bytes()))
    packed[-6] ^= 1  # checksum
    path.write_bytes(packed)
    with pytest.raises(LogError, match="the packed file is damaged"):
        read_log(path)


def test_a_bomb_of_one_endless_line_is_refused_at_that_line(
    header: Any, write_lines: Write
) -> None:
    path = write_lines(header)
    path.write_bytes(gzip.compress(path.read_bytes() + b" " * 2**25))
    with pytest.raises(TooLargeError, match="line 2: longer than 1 MB"):
        read_log(path)


def test_a_bomb_of_many_lines_is_refused_by_how_well_it_packs(
    header: Any, write_lines: Write
) -> None:
    path = write_lines(header)
    path.write_bytes(gzip.compress(path.read_bytes() + (b" " * 2**16 + b"\n") * 600))
    with pytest.raises(TooLargeError, match="unpacks to more than 16 MB"):
        read_log(path)


def test_a_line_of_a_gigabyte_is_refused_soon(header: Any, write_lines: Write) -> None:
    path = write_lines(header)
    with path.open("r+b") as file:
        file.seek(0, os.SEEK_END)
        file.write(b'{"t": ')
        file.truncate(10**9)  # a hole: takes no room on disk
    start = time.monotonic()
    with pytest.raises(TooLargeError, match="line 2: longer than 1 MB"):
        read_log(path)
    assert time.monotonic() - start < 2


@pytest.mark.parametrize(
    ("count", "message"),
    [(257, "257 sonars; a ring has at most 256"), (200_000, "200000 sonars|longer than 1 MB")],
)
def test_too_many_sonars_are_refused(
    count: int, message: str, header: Any, write_lines: Write
) -> None:
    header["sonars"] = [{}] * count
    with pytest.raises(TooLargeError, match=f"line 1: ({message})"):
        read_log(write_lines(header))


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        (ReadLimits(max_lines=30), "more than 30 lines"),
        (ReadLimits(max_readings=90), "line 32: more than 30 scans of 3 sonars"),
        (ReadLimits(max_bytes=2000), "unpacks to more than"),
    ],
)
def test_limits_are_counted_while_reading(
    limits: ReadLimits, message: str, header: Any, scans: Any, write_lines: Write
) -> None:
    with pytest.raises(TooLargeError, match=message):
        read_log(write_lines(header, *scans), limits=limits)


def outcome_of(path: Path) -> str:
    """The error, or the first sentence of the report."""
    try:
        return read_log(path).report.verdict[0]
    except (LogError, TooLargeError) as error:
        return str(error)


@settings(
    max_examples=80, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_garbage_in_a_log_is_an_error_or_a_log_never_a_crash(
    data: st.DataObject, header: Any, scans: Any, write_lines: Write
) -> None:
    path = write_lines(header, *scans[:6])
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(0, len(content)))
        removed = data.draw(st.integers(0, 20))
        junk = st.sampled_from(
            (b"NaN", b"-", b"9" * 30, b"[", b"{", b'"', b"\n", b"null", b"1e999")
        )
        content[place : place + removed] = data.draw(st.one_of(st.binary(max_size=8), junk))
    path.write_bytes(content)
    outcome = outcome_of(path)
    assert "\n" not in outcome
    assert outcome.startswith(("log.jsonl", "Good", "Not good"))
