"""Delimited text with a log.yaml: columns, units, sentinels, joining."""

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

from core.errors import LogError, TooLargeError
from core.log_readers import LoadedLog, read_log
from core.log_readers.limits import DEFAULT_LIMITS, ReadLimits
from core.log_readers.ring_file import table_of
from core.sensing import RING_PRESETS, SonarRing

RING = RING_PRESETS["circle-8"]
PAIR = SonarRing(RING.sonars[:2], 0.2)
POSES = {"path": "poses.txt", "columns": {"t": 0, "x": 1, "y": 2, "heading": 3}}
SONAR = {"path": "sonar.txt", "columns": {"t": 0, "ranges": [1, 2]}}

Load = Callable[..., LoadedLog]


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Writes a folder with a log.yaml and the given files, and reads it."""

    def write_and_read(
        files: list[dict[str, Any]],
        ring: Any = None,
        limits: ReadLimits = DEFAULT_LIMITS,
        **texts: str,
    ) -> LoadedLog:
        description = {"ring": table_of(PAIR) if ring is None else ring, "files": files}
        (tmp_path / "log.yaml").write_text(json.dumps(description), encoding="utf-8")
        for name, text in texts.items():
            path = tmp_path / name.replace("_", ".")
            path.write_text(text, encoding="utf-8")
        return read_log(tmp_path, limits=limits)

    return write_and_read


def rows(*table: tuple[float, ...]) -> str:
    return "".join(" ".join(str(value) for value in row) + "\n" for row in table)


def test_units_are_brought_to_metres_seconds_and_radians(load: Load) -> None:
    log = load(
        [
            POSES | {"units": {"time": "ms", "position": "mm", "heading": "0.1 deg"}},
            SONAR | {"units": {"time": "us", "range": "cm"}},
        ],
        poses_txt=rows((1000, 1500, -250, 900), (2000, 1500, -250, 1800)),
        sonar_txt=rows((1_000_000, 123, 45), (2_000_000, 124, 46)),
    ).log
    np.testing.assert_allclose(log.t, [1, 2])
    np.testing.assert_allclose(log.odometry[0], [1.5, -0.25, math.pi / 2])
    np.testing.assert_allclose(log.ranges, [[1.23, 0.45], [1.24, 0.46]])


def test_a_number_as_a_unit_is_a_factor(load: Load) -> None:
    inches = {"units": {"range": 0.0254}}
    log = load([POSES, SONAR | inches], poses_txt=rows((0, 0, 0, 0)), sonar_txt=rows((0, 10, 100)))
    np.testing.assert_allclose(log.log.ranges, [[0.254, 2.54]])


def test_no_echo_is_a_value_a_limit_a_blank_nan_or_inf(load: Load) -> None:
    sonar = SONAR | {
        "delimiter": ",",
        "no_echo": [0, -1],
        "no_echo_from": 500,
        "units": {"range": "cm"},
    }
    log = load(
        [POSES, sonar],
        poses_txt=rows((0, 0, 0, 0), (9, 0, 0, 0)),
        sonar_txt="0,0,100\n1,-1,100\n2,500,100\n3,,100\n4,nan,100\n5,inf,100\n6,-,100\n",
    ).log
    assert np.isnan(log.ranges[:, 0]).all()
    assert (log.ranges[:, 1] == 1.0).all()


def test_too_close_is_neither_an_echo_nor_no_echo(load: Load) -> None:
    loaded = load(
        [POSES, SONAR | {"too_close": 0.17}],
        poses_txt=rows((0, 0, 0, 0)),
        sonar_txt=rows((0, 0.17, 0.18)),
    )
    assert np.isnan(loaded.log.ranges[0, 0])
    assert loaded.log.fresh.tolist() == [[False, True]]
    assert [note.what for note in loaded.report.notes] == [
        "readings of something too close to measure"
    ]


def test_poses_are_interpolated_the_short_way_round(load: Load) -> None:
    log = load(
        [POSES | {"units": {"heading": "deg"}}, SONAR],
        poses_txt=rows((0, 0, 0, 350), (1, 1, 2, 10)),
        sonar_txt=rows((0.25, 1, 1), (0.5, 1, 1)),
    ).log
    np.testing.assert_allclose(
        log.odometry, [[0.25, 0.5, math.radians(-5)], [0.5, 1, 0]], atol=1e-12
    )


def test_scans_without_a_pose_near_them_are_left_out(load: Load) -> None:
    loaded = load(
        [POSES, SONAR],
        poses_txt=rows((1, 0, 0, 0), (2, 1, 0, 0), (5, 2, 0, 0), (9, 2, 0, 0)),
        sonar_txt=rows(*((t, 1, 1) for t in (0.4, 0.6, 1.5, 3, 5, 7, 9.4, 9.6))),
    )
    assert loaded.log.t.tolist() == [0.6, 1.5, 5, 7, 9.4]  # 3 s: moved in a gap; 7 s: stood still
    assert loaded.log.odometry[:, 0].tolist() == [0, 0.5, 2, 2, 2]
    assert [(f.what, f.lines) for f in loaded.report.skipped] == [
        ("no pose near that time", (1, 4, 8))
    ]


def test_files_of_two_clocks_are_an_error(load: Load) -> None:
    with pytest.raises(LogError, match=r"sonar.txt: no row has a pose near its time"):
        load([POSES, SONAR], poses_txt=rows((0, 0, 0, 0)), sonar_txt=rows((1e9, 1, 1)))


def test_an_offset_brings_two_clocks_together(load: Load) -> None:
    sonar = SONAR | {"time_offset": -1e9}
    log = load([POSES, sonar], poses_txt=rows((0, 0, 0, 0)), sonar_txt=rows((1e9, 1, 1)))
    assert log.log.t.tolist() == [0]


def test_names_from_a_header_row_and_one_file_for_everything(load: Load) -> None:
    file = {
        "path": "all.csv",
        "columns": {"t": "time", "x": "X", "y": "Y", "heading": "th", "ranges": ["left", "front"]},
        "sonars": [1, 0],
        "skip_rows": 1,
    }
    text = 'made by a logger\n"front","left","time","X","Y","th",note\n1.5,0.5,3,4,5,0.1,0\n'
    log = load([file], all_csv=text).log
    assert log.t.tolist() == [3]
    assert log.odometry.tolist() == [[4, 5, 0.1]]
    assert log.ranges.tolist() == [[1.5, 0.5]]


def test_decimal_commas_comments_and_gzip(load: Load, tmp_path: Path) -> None:
    (tmp_path / "sonar.gz").write_bytes(gzip.compress(b"# sonar\n0;1,5;2,5 # first\n\n"))
    log = load(
        [POSES, SONAR | {"path": "sonar.gz", "decimal": ","}], poses_txt=rows((0, 0, 0, 0))
    ).log
    assert log.ranges.tolist() == [[1.5, 2.5]]


def test_one_file_for_each_sonar_is_merged_by_time(load: Load) -> None:
    one = {"columns": {"t": 0, "ranges": [1]}}
    log = load(
        [POSES, one | {"path": "a.txt", "sonars": [0]}, one | {"path": "b.txt", "sonars": [1]}],
        poses_txt=rows((0, 0, 0, 0), (3, 0, 0, 0)),
        a_txt=rows((0, 1.0), (2, 1.2)),
        b_txt=rows((1, 2.1), (2, 2.2)),
    ).log
    assert log.t.tolist() == [0, 1, 2]
    assert log.fresh.tolist() == [[True, False], [False, True], [True, True]]
    np.testing.assert_array_equal(log.ranges, [[1.0, np.nan], [np.nan, 2.1], [1.2, 2.2]])


def test_true_poses_from_their_own_file_are_kept_apart(load: Load) -> None:
    truth = {
        "path": "truth.txt",
        "columns": {"t": 0, "truth_x": 1, "truth_y": 2, "truth_heading": 3},
    }
    texts = {"poses_txt": rows((0, 0, 0, 0), (5, 0, 0, 0)), "sonar_txt": rows((1, 1, 1), (4, 1, 1))}
    log = load(
        [POSES, SONAR, truth], truth_txt=rows(*((t, 7 + t, 8, 1) for t in range(5))), **texts
    ).log
    assert log.truth is not None
    assert log.truth.tolist() == [[8, 8, 1], [11, 8, 1]]
    loaded = load([POSES, SONAR, truth], truth_txt=rows((0, 7, 8, 1), (2, 7, 8, 1)), **texts)
    assert loaded.log.truth is None
    assert "the truth is not used" in loaded.report.notes[0].what


def test_the_ring_may_be_a_preset_or_a_file_beside_it(load: Load, tmp_path: Path) -> None:
    eight = {**SONAR, "columns": {"t": 0, "ranges": list(range(1, 9))}}
    texts = {"poses_txt": rows((0, 0, 0, 0)), "sonar_txt": rows((0, *[1] * 8))}
    (tmp_path / "my ring.json").write_text(json.dumps(table_of(RING)), encoding="utf-8")
    for ring in ("circle-8", "my ring.json"):
        assert load([POSES, eight], ring=ring, **texts).log.ring == RING


def test_a_log_without_a_ring_takes_the_one_that_is_given(load: Load, tmp_path: Path) -> None:
    (tmp_path / "log.yaml").write_text(json.dumps({"files": [POSES, SONAR]}), encoding="utf-8")
    (tmp_path / "poses.txt").write_text("0 0 0 0\n", encoding="utf-8")
    (tmp_path / "sonar.txt").write_text("0 1 1\n", encoding="utf-8")
    assert read_log(tmp_path, PAIR).log.ring == PAIR
    with pytest.raises(LogError, match="no `ring`; name one"):
        read_log(tmp_path)


def test_a_last_row_that_was_cut_is_left_out(load: Load) -> None:
    loaded = load([POSES, SONAR], poses_txt=rows((0, 0, 0, 0)), sonar_txt="0 1 1\n0.1 1")
    assert len(loaded.log) == 1
    assert loaded.report.skipped[0].lines == (2,)


@pytest.mark.parametrize(
    ("sonar", "message"),
    [
        ("", "the rows|no rows"),
        ("0 1 1\n1 1\n2 1 1\n", "line 2: 2 columns where the rows above have 3"),
        ("0 1 1\n1 1 1 1\n", "line 2: 4 columns where"),
        ("0 1 1\n1 1 one\n", "line 2: 'one' is no number"),
        ("0 1 1\nnan 1 1\n", "line 2: no time"),
        ("0 1\n", "line 1: column 2 is asked for, but there are 2"),
        ("3 1 1\n2 1 1\n1 1 1\n", "line 2: time runs backwards"),
    ],
)
def test_a_wrong_row_is_one_error_with_file_and_line(sonar: str, message: str, load: Load) -> None:
    with pytest.raises(LogError, match=rf"sonar.txt.*({message})"):
        load([POSES, SONAR], poses_txt=rows((0, 0, 0, 0), (9, 0, 0, 0)), sonar_txt=sonar)


@pytest.mark.parametrize("pose", ["0 nan 0 0", "0 1e12 0 0", "0 0 0 1e9", "0 0 0 -"])
def test_a_wrong_pose_is_an_error_with_file_and_line(pose: str, load: Load) -> None:
    with pytest.raises(LogError, match=r"poses.txt, line 1: (pose|heading)"):
        load([POSES, SONAR], poses_txt=pose + "\n", sonar_txt="0 1 1\n")


WRONG_DESCRIPTIONS = {
    "5": "must be a table",
    "files: []": "files: List should have at least 1 item",
    "files: [{path: a}]": r"files\[0\].columns: Field required",
    "files: [{path: a, columns: {t: 0, x: 1}}]": "x, y and heading must be given together",
    "files: [{path: a, columns: {t: 0, ranges: [1]}}]": "0 files have x, y, heading",
    "files: [{path: a, columns: {t: 0, x: 1, y: 2, heading: 3}}]": "no file has `ranges`",
    "files: [{path: a, colums: {}}]": r"files\[0\].columns: Field required",
    "files: [": "line 1: no valid YAML",
    "files: [{path: a, columns: {t: -1, ranges: [0]}}]": r"columns.t",
    "a: &a [x]\nb: [*a]": "line 2: no valid YAML .aliases",
    "a: !!python/object/apply:os.system [id]": "no valid YAML .could not determine a constructor",
    "files: 2001-99-99": "no valid YAML .month must be",
    "\x00": "no valid YAML",
    "[" * 1500: "no valid YAML .nested too deep",
}


@pytest.mark.parametrize(
    ("text", "message"), WRONG_DESCRIPTIONS.items(), ids=range(len(WRONG_DESCRIPTIONS))
)
def test_a_wrong_description_is_one_error(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "log.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(LogError, match=rf"log.yaml.*{message}") as caught:
        read_log(tmp_path)
    assert "\n" not in str(caught.value)


def test_a_huge_description_is_refused(tmp_path: Path) -> None:
    (tmp_path / "log.yaml").write_text("files: []\n" * 20_000, encoding="utf-8")
    with pytest.raises(TooLargeError, match="longer than 128 kB"):
        read_log(tmp_path)


def test_rows_are_counted_while_reading(load: Load, tmp_path: Path) -> None:
    load([POSES, SONAR], poses_txt=rows((0, 0, 0, 0)), sonar_txt=rows((0, 1, 1)))
    (tmp_path / "sonar.txt").write_text("0 1 1\n" * 50, encoding="utf-8")
    with pytest.raises(TooLargeError, match="more than 90 numbers"):
        read_log(tmp_path, limits=ReadLimits(max_readings=90))


def test_readings_are_counted_over_all_files(load: Load) -> None:
    one = {"columns": {"t": 0, "ranges": [1]}}
    files = [POSES] + [one | {"path": f"{i}.txt", "sonars": [i]} for i in range(2)]
    with pytest.raises(TooLargeError, match="more than 30 readings"):
        load(
            files,
            limits=ReadLimits(max_readings=30),
            poses_txt=rows((0, 0, 0, 0)),
            **{f"{i}_txt": rows(*((t, 1) for t in range(8))) for i in range(2)},
        )


@settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(place=st.integers(0, 400), removed=st.integers(0, 10), junk=st.binary(max_size=6))
def test_garbage_in_a_description_is_an_error_or_a_log(
    place: int, removed: int, junk: bytes, load: Load, tmp_path: Path
) -> None:
    load([POSES, SONAR], poses_txt=rows((0, 0, 0, 0)), sonar_txt=rows((0, 1, 1)))
    content = bytearray((tmp_path / "log.yaml").read_bytes())
    content[place : place + removed] = junk
    (tmp_path / "log.yaml").write_bytes(content)
    try:
        scans = read_log(tmp_path).report.scans
    except (LogError, TooLargeError) as error:
        message = str(error)
    else:
        message = f"{scans} scan"
    assert "\n" not in message
    assert message.startswith((tmp_path.name, "1 scan"))
