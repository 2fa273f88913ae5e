from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from core.errors import InputError
from core.sensing import RobotLog, Trajectory


def test_a_trajectory_survives_its_file(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    trajectory = Trajectory(
        np.arange(20) / 4, rng.uniform(-9, 9, (20, 3)), rng.random(20), rng.random(20)
    )
    trajectory.write_csv(tmp_path / "trajectory.csv")
    back = Trajectory.read_csv(tmp_path / "trajectory.csv")
    np.testing.assert_allclose(back.t, trajectory.t)
    np.testing.assert_allclose(back.poses, trajectory.poses, rtol=1e-5)
    np.testing.assert_allclose(back.sigma_xy, trajectory.sigma_xy, rtol=1e-5)
    np.testing.assert_allclose(back.sigma_heading, trajectory.sigma_heading, rtol=1e-5)


def test_odometry_as_a_trajectory_is_exact_and_has_no_spread(square_room: RobotLog) -> None:
    trajectory = Trajectory.from_odometry(square_room)
    assert len(trajectory) == len(square_room)
    np.testing.assert_array_equal(trajectory.poses, square_room.odometry)
    assert not trajectory.sigma_xy.any()


@pytest.mark.parametrize(
    "text", ["", "a,b\n1,2\n", "t,x,y,heading,sigma_xy,sigma_heading\n1,2,3,4,5,six\n"]
)
def test_another_file_is_an_error_that_names_it(text: str, tmp_path: Path) -> None:
    (tmp_path / "trajectory.csv").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=r"trajectory\.csv: "):
        Trajectory.read_csv(tmp_path / "trajectory.csv")


def test_a_missing_file_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        Trajectory.read_csv(tmp_path / "nothing.csv")
