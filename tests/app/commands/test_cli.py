"""The command line as a user meets it: files, exit status, one line of error."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.cli import run
from core.log_readers.native import write_native
from core.mapping.map_server import read_map
from core.sensing import RING_PRESETS, RobotLog, Trajectory
from core.topology.model_folder import read_model


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A drive along a wall, 12 sonars."""
    n = 40
    odometry = np.column_stack((np.linspace(0, 2, n), np.zeros(n), np.zeros(n)))
    ranges = np.tile(np.linspace(0.8, 1.3, 12), (n, 1)) + np.linspace(0, 0.1, n)[:, None]
    path = tmp_path_factory.mktemp("log") / "drive.jsonl.gz"
    drive = RobotLog(
        "drive",
        RING_PRESETS["paper-12"],
        np.arange(n) * 0.25,
        odometry,
        ranges,
        np.ones(ranges.shape, bool),
    )
    write_native(drive, path)
    return path


def fails(capsys: pytest.CaptureFixture[str], *arguments: object) -> str:
    """Runs a command that must fail with status 2 and returns its single line of error."""
    assert run([str(a) for a in arguments]) == 2
    error = capsys.readouterr().err
    assert error.startswith("error: ")
    assert error.count("\n") == 1
    return error


def test_map_writes_a_map_and_the_trajectory_it_was_made_at(log: Path, tmp_path: Path) -> None:
    assert run(["map", str(log), "--out", str(tmp_path / "m")]) == 0
    assert read_map(tmp_path / "m" / "map.yaml").free.any()
    assert len(Trajectory.read_csv(tmp_path / "m" / "trajectory.csv")) == 40


def test_model_of_a_log_and_of_a_map(log: Path, tmp_path: Path) -> None:
    assert run(["model", str(log), "--regions", "3", "--out", str(tmp_path / "a")]) == 0
    assert len(read_model(tmp_path / "a").topology.nodes) == 3
    from_map = ["model", str(tmp_path / "a" / "map.yaml"), "--regions", "2"]
    assert run([*from_map, "--out", str(tmp_path / "b")]) == 0
    assert len(read_model(tmp_path / "b").topology.nodes) == 2


def test_what_cannot_be_is_a_usage_error(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = ["--out", tmp_path / "x"]
    both = fails(capsys, "model", log, "--mode", "autonomous", "--regions", 3, *out)
    assert "regions" in both
    assert "0 regions" in fails(capsys, "model", log, "--regions", 0, *out)
    assert "10000" in fails(capsys, "model", log, "--regions", 10000, *out)
    assert "no such" in fails(capsys, "map", tmp_path / "gone.jsonl", *out).lower()
    assert "--out" in fails(capsys, "map", log)
    assert "frobnicate" in fails(capsys, "frobnicate")
    assert not (tmp_path / "x").exists()


def test_a_failure_leaves_the_earlier_result_alone(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "m"
    assert run(["model", str(log), "--regions", "2", "--out", str(out)]) == 0
    before = {p.name: p.read_bytes() for p in out.iterdir()}
    fails(capsys, "model", log, "--regions", 10000, "--out", out)
    assert {p.name: p.read_bytes() for p in out.iterdir()} == before
    assert [p.name for p in tmp_path.iterdir()] == ["m"]


def test_a_folder_with_other_things_is_not_overwritten(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "letters.txt").write_text("dear")
    assert "choose another" in fails(capsys, "map", log, "--out", tmp_path)
    assert (tmp_path / "letters.txt").read_text() == "dear"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "empty"),
        (b"\x89PNG\r\n\x1a\n" + bytes(100), ""),
        (b'{"format": "echorooms-log", "version": 1}\n', "line 1"),
    ],
)
def test_a_file_that_is_no_log_is_refused(
    content: bytes, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bad.jsonl"
    path.write_bytes(content)
    error = fails(capsys, "map", path, "--out", tmp_path / "x")
    assert "bad.jsonl" in error
    assert said in error


def test_the_installed_command_answers_without_a_traceback() -> None:
    command = [
        sys.executable,
        "-c",
        "from app.cli import main; main()",
        "map",
        "nowhere",
        "--out",
        "x",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr == "error: nowhere: no such file or folder\n"


def test_a_calibration_is_kept_and_used_again(log: Path, tmp_path: Path) -> None:
    robot = tmp_path / "robot.json"
    arguments = ["map", str(log), "--out", str(tmp_path / "m"), "--calibration", str(robot)]

    assert run(arguments) == 0
    kept = json.loads(robot.read_text())
    robot.write_text(json.dumps(kept | {"turn_scale": 0.01, "turn_scale_sigma": 0.001}))
    assert run(arguments) == 0

    again = json.loads(robot.read_text())
    assert kept["format"] == "echorooms-calibration"
    assert again["turn_scale"] == pytest.approx(0.01, abs=1e-3)
    assert again["turn_scale_sigma"] < kept["turn_scale_sigma"]


def test_a_file_that_is_no_calibration_is_refused(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    robot = tmp_path / "robot.json"
    robot.write_text("{}")

    error = fails(capsys, "map", log, "--out", tmp_path / "m", "--calibration", robot)

    assert "robot.json is no calibration" in error
    assert not (tmp_path / "m").exists()
