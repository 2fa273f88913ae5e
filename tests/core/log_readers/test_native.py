from __future__ import annotations

import gzip
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from core.errors import LogError
from core.log_readers import read_log
from core.log_readers.native import header_of, parse_header, parse_scan, write_native
from core.sensing import RING_PRESETS, RobotLog

Write = Callable[..., Path]
RING = RING_PRESETS["circle-8"]


@st.composite
def drives(draw: st.DrawFn) -> RobotLog:
    count = draw(st.integers(1, 12))
    steps = draw(hnp.arrays(float, count, elements=st.floats(0.01, 50)))
    coordinate = st.floats(-10_000, 10_000)
    position = draw(hnp.arrays(float, (count, 2), elements=coordinate))
    heading = draw(hnp.arrays(float, (count, 1), elements=st.floats(-math.pi, math.pi)))
    echo = st.one_of(st.floats(0.001, 4.0), st.just(math.nan))
    ranges = draw(hnp.arrays(float, (count, 8), elements=echo))
    fresh = draw(hnp.arrays(bool, (count, 8)))
    poses = np.hstack((position, heading))
    truth = draw(st.sampled_from((None, poses[::-1])))
    fresh[0, 0] = False
    return RobotLog("drive", RING, np.cumsum(steps), poses, ranges, fresh, truth)


@settings(
    max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(log=drives(), suffix=st.sampled_from((".jsonl", ".jsonl.gz")))
def test_a_written_log_reads_back_to_the_millimetre(
    log: RobotLog, suffix: str, tmp_path: Path
) -> None:
    path = tmp_path / f"log{suffix}"
    write_native(log, path)
    back = read_log(path).log
    assert back.name == log.name
    assert back.ring == log.ring
    np.testing.assert_allclose(back.t, log.t, atol=1e-4)
    np.testing.assert_allclose(back.odometry, log.odometry, atol=1e-4)
    np.testing.assert_allclose(back.ranges, log.ranges, atol=5.1e-4)
    np.testing.assert_array_equal(back.fresh, log.fresh)
    assert (back.truth is None) == (log.truth is None)


def test_the_same_log_gives_the_same_bytes(square_room: RobotLog, tmp_path: Path) -> None:
    for name in ("a.jsonl.gz", "b.jsonl.gz"):
        write_native(square_room, tmp_path / name)
    assert (tmp_path / "a.jsonl.gz").read_bytes() == (tmp_path / "b.jsonl.gz").read_bytes()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.jsonl.gz", "b.jsonl.gz"]


def test_content_decides_not_the_name(header: Any, scans: Any, write_lines: Write) -> None:
    plain = write_lines(header, *scans, name="drive.png")
    packed = plain.with_name("drive.txt")
    packed.write_bytes(gzip.compress(plain.read_bytes()))
    assert len(read_log(plain).log) == len(read_log(packed).log) == 60


def test_a_header_survives_the_way_through_json(square_room: RobotLog) -> None:
    name, ring = parse_header(json.loads(json.dumps(header_of(square_room))))
    assert (name, ring) == (square_room.name, square_room.ring)


def test_null_nan_infinity_and_impossible_ranges_are_no_echo(header: Any) -> None:
    _, ring = parse_header(header)
    line = '{"t": 1, "odom": [0, 0, 0], "ranges": [%s, %s, %s]}'
    for values in (("null", "NaN", "Infinity"), ("-1", "0", "1e12")):
        assert np.isnan(parse_scan(json.loads(line % values), ring).ranges).all()
    near = parse_scan(json.loads(line % ("0.05", "4.0", "2")), ring)
    assert near.ranges.tolist() == [0.05, 4.0, 2.0]
    assert near.fresh.all()


def test_a_scan_may_say_which_values_are_stale(header: Any, scans: Any, write_lines: Write) -> None:
    scans[3]["stale"] = [0, 2]
    fresh = read_log(write_lines(header, *scans)).log.fresh
    assert fresh[3].tolist() == [False, True, False]
    assert (~fresh).sum() == 2


def test_a_last_line_that_was_cut_is_left_out_and_reported(
    header: Any, scans: Any, write_lines: Write
) -> None:
    path = write_lines(header, *scans)
    path.write_bytes(path.read_bytes()[:-20])
    loaded = read_log(path)
    assert len(loaded.log) == 59
    assert [(f.what, f.lines) for f in loaded.report.skipped] == [
        ("last line cut in the middle", (61,))
    ]


def test_a_log_without_sonars_takes_the_ring_that_is_given(
    header: Any, scans: Any, write_lines: Write
) -> None:
    del header["sonars"], header["robot"]
    for scan in scans:
        scan["ranges"] = [1.0] * 8
    path = write_lines(header, *scans)
    assert read_log(path, RING).log.ring == RING
    with pytest.raises(LogError, match=r"log.jsonl, line 1: robot: Field required"):
        read_log(path)


def test_a_log_with_sonars_keeps_its_own_ring_and_says_so(
    header: Any, scans: Any, write_lines: Write
) -> None:
    loaded = read_log(write_lines(header, *scans), RING)
    assert len(loaded.log.ring) == 3
    assert [note.what for note in loaded.report.notes] == ["ring given, but the log's own is used"]


def test_truth_is_kept_only_if_every_scan_has_it(
    header: Any, scans: Any, write_lines: Write
) -> None:
    for scan in scans:
        scan["truth"] = [1.0, 2.0, 7.0]
    truth = read_log(write_lines(header, *scans)).log.truth
    assert truth is not None
    assert truth[0].tolist() == [1.0, 2.0, pytest.approx(7.0 - 2 * math.pi)]
    del scans[7]["truth"]
    loaded = read_log(write_lines(header, *scans))
    assert loaded.log.truth is None
    assert "truth" in loaded.report.notes[0].what


def test_a_byte_order_mark_windows_line_ends_and_blank_lines_are_fine(
    header: Any, scans: Any, tmp_path: Path
) -> None:
    path = tmp_path / "log.jsonl"
    text = "\r\n\r\n".join(json.dumps(line) for line in (header, *scans))
    path.write_text("\ufeff" + text, encoding="utf-8", newline="")
    assert len(read_log(path).log) == 60


WRONG_SCANS = {
    "[1, 2]": "a scan is an object",
    '{"t": 1': "not a line of JSON",
    '{"odom": [0, 0, 0], "ranges": [1, 1, 1]}': "t must be a time in seconds, not null",
    '{"t": NaN, "odom": [0, 0, 0], "ranges": [1, 1, 1]}': "t must be a time in seconds, not NaN",
    '{"t": true, "odom": [0, 0, 0], "ranges": [1, 1, 1]}': "t must be a time in seconds, not true",
    '{"t": 1, "odom": [0, 0], "ranges": [1, 1, 1]}': r"odom must be \[x, y, heading\]",
    '{"t": 1, "odom": [NaN, 0, 0], "ranges": [1, 1, 1]}': "not within 10 km",
    '{"t": 1, "odom": [1e12, 0, 0], "ranges": [1, 1, 1]}': "not within 10 km",
    '{"t": 1, "odom": [0, 0, 1e9], "ranges": [1, 1, 1]}': "no angle",
    '{"t": 1, "odom": [0, 0, 0], "ranges": [1, 1]}': "2 ranges for 3 sonars",
    '{"t": 1, "odom": [0, 0, 0], "ranges": [1, 1, "1"]}': "ranges must be numbers or null",
    '{"t": 1, "odom": [0, 0, 0], "ranges": [1, 1, %s]}' % ("9" * 400): "a number is too large",
    '{"t": 1, "odom": [0, 0, 0], "ranges": [1, 1, %s]}' % ("9" * 5000): "not a line of JSON",
    '{"t": 1, "odom": [0, 0, 0], "ranges": {}}': "ranges must be a list",
    '{"t": 1, "odom": [0, 0, 0], "ranges": [1, 1, 1], "truth": 5}': "truth must be",
    '{"t": 1, "odom": [0, 0, 0], "ranges": [1, 1, 1], "stale": [3]}': "stale must be",
    "[" * 100_000: "nested too deep",
}


@pytest.mark.parametrize(("line", "message"), WRONG_SCANS.items(), ids=range(len(WRONG_SCANS)))
def test_a_wrong_scan_is_one_error_with_its_line(
    line: str, message: str, header: Any, scans: Any, write_lines: Write
) -> None:
    with pytest.raises(LogError, match=message) as caught:
        read_log(write_lines(header, *scans[:5], line, *scans[5:]))
    assert (caught.value.source, caught.value.line) == ("log.jsonl", 7)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"format": "something"}, "the first line must be a header"),
        ({"version": 2}, "version 2 is not known"),
        ({"name": ["x"]}, "name must be text"),
        ({"robot": {}}, "robot.radius: Field required"),
        ({"robot": {"radius": 100}}, "robot.radius 100 m must be between"),
        ({"sonars": []}, "sonars"),
        (
            {"sonars": [SONAR := {"x": 0, "y": 0, "heading": 0}]},
            r"sonars\[0\].beam_width is missing",
        ),
        (
            {"sonars": [{**SONAR, "beam_width": 1, "min_range": 2, "max_range": 1}]},
            "must be rising",
        ),
        ({"sonars": [{"x": 1e12, "y": 0, "heading": 0}], "beam_width": 1}, "missing"),
    ],
)
def test_a_wrong_header_is_an_error_in_line_one(
    change: dict[str, Any], message: str, header: Any, scans: Any, write_lines: Write
) -> None:
    with pytest.raises(LogError, match=message) as caught:
        read_log(write_lines(header | change, *scans))
    assert caught.value.line == 1
