"""A robot's calibration as a file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from core.errors import InputError
from core.mapping.odometry_calibration import OdometryCalibration
from core.mapping.odometry_model import OdometryNoise
from core.pipeline.calibration_file import read_calibration, write_calibration
from core.pipeline.odometry import trajectory_for
from core.sensing.ring import circle
from core.simulation import DriveConfig, simulate

KNOWN = OdometryCalibration(0.01, -0.021, 0.002, 0.004, 0.003, 0.0005)


def test_a_file_is_read_as_it_was_written(tmp_path: Path) -> None:
    write_calibration(tmp_path / "robot.json", KNOWN, circle(12))

    assert read_calibration(tmp_path / "robot.json", circle(12)) == KNOWN


def test_another_robots_file_is_refused(tmp_path: Path) -> None:
    write_calibration(tmp_path / "robot.json", KNOWN, circle(12))

    with pytest.raises(InputError, match="another sonar ring"):
        read_calibration(tmp_path / "robot.json", circle(8))


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"format": "echorooms-calibration"}', "[" * 9999]
)
def test_a_broken_file_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "robot.json").write_text(text)

    with pytest.raises(InputError, match=r"robot\.json is no"):
        read_calibration(tmp_path / "robot.json", circle(12))


def test_what_is_known_grows_a_little_older_until_the_next_drive() -> None:
    before = KNOWN.known_before(OdometryNoise(turn_scale=0.02))

    assert before.expected == (0.01, -0.021, 0.002)
    assert before.turn_scale == pytest.approx((0.003**2 + 0.005**2) ** 0.5)


def test_a_known_robot_is_corrected_where_the_sonar_says_nothing() -> None:
    drive = simulate("paper", seed=3, odometry="bad", config=DriveConfig(mapping_length=20.0))
    start = drive.slice(0, 60)
    silent = replace(start, ranges=start.ranges * float("nan"))

    from core.pipeline.odometry import OdometryConfig

    found = trajectory_for(silent, config=OdometryConfig().knowing(KNOWN)).calibration

    assert found is not None
    assert found.turn_scale == pytest.approx(KNOWN.turn_scale, abs=1e-6)
