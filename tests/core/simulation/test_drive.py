"""Drives: what a simulated log promises."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError, UsageError
from core.geometry import travelled
from core.sensing import RING_PRESETS, RobotLog, SonarRing
from core.simulation import DriveConfig, Home, build_home, simulate, truth_of
from core.simulation.changes import changed_home
from core.simulation.outline import outline_of
from core.simulation.robot import clearance_at

SHORT = DriveConfig(localization_length=(6.0, 6.0), mapping_length=0.0)


def truth_poses(log: RobotLog) -> np.ndarray:
    assert log.truth is not None
    return log.truth


def test_a_mapping_tour_starts_at_the_true_pose_and_scans_at_4_hz(paper_tour: RobotLog) -> None:
    assert paper_tour.odometry[0] == pytest.approx(truth_poses(paper_tour)[0])
    assert np.diff(paper_tour.t) == pytest.approx(0.25)
    assert paper_tour.fresh.all()


def test_a_mapping_tour_is_as_long_as_the_papers(paper_tour: RobotLog) -> None:
    assert 80 < travelled(truth_poses(paper_tour))[-1] < 130
    assert 25_000 < paper_tour.ranges.size < 45_000


def test_a_mapping_tour_sees_every_room(paper: Home, paper_tour: RobotLog) -> None:
    truth = truth_of(paper)
    explored = truth.explored(paper_tour)
    for number in range(1, len(paper.rooms) + 1):
        assert explored[truth.rooms == number].mean() > 0.97
    cells = truth.geometry.cell_of(truth_poses(paper_tour)[:, :2])
    assert set(np.unique(truth.rooms[cells[:, 0], cells[:, 1]])) == {1, 2, 3, 4, 5, 6}


def test_the_robot_keeps_clear_of_everything(paper: Home, paper_tour: RobotLog) -> None:
    faces = outline_of(paper).faces
    nearest = min(clearance_at(faces, x, y) for x, y, _ in truth_poses(paper_tour)[::5])
    assert nearest > paper_tour.ring.robot_radius


@pytest.mark.parametrize("seed", [7, 12])
def test_the_robot_never_dawdles(seed: int) -> None:
    log = simulate("paper", seed=seed, tour="localization")
    still = np.hypot(*np.diff(truth_poses(log)[:, :2], axis=0).T) < 0.002
    longest = max(len(run) for run in "".join("x" if s else " " for s in still).split(" "))
    assert longest * 0.25 < 6.0  # seconds: half a turn on the spot
    assert 0.12 < travelled(truth_poses(log))[-1] / log.duration_s < 0.17


def test_a_localization_drive_starts_anywhere_and_its_odometry_at_zero() -> None:
    one = simulate("paper", seed=5, tour="localization", config=SHORT)
    two = simulate("paper", seed=6, tour="localization", config=SHORT)
    assert one.odometry[0] == pytest.approx((0.0, 0.0, 0.0))
    assert np.hypot(*(truth_poses(one)[0] - truth_poses(two)[0])[:2]) > 0.1


def test_a_localization_drive_is_25_to_40_m_long() -> None:
    log = simulate("mirrored", seed=3, tour="localization")
    assert 25 <= travelled(truth_poses(log))[-1] <= 40.1


def test_equal_arguments_give_equal_logs() -> None:
    one, two = (simulate("paper", seed=7, tour="localization", config=SHORT) for _ in range(2))
    assert np.array_equal(one.ranges, two.ranges, equal_nan=True)
    assert np.array_equal(one.odometry, two.odometry)
    assert np.array_equal(truth_poses(one), truth_poses(two))


def test_the_odometry_does_not_change_the_drive() -> None:
    good, bad = (
        simulate("paper", seed=7, tour="localization", config=SHORT, odometry=name)
        for name in ("none", "bad")
    )
    assert np.array_equal(truth_poses(good), truth_poses(bad))
    assert np.array_equal(good.ranges, bad.ranges, equal_nan=True)
    assert not np.allclose(good.odometry, bad.odometry)


@pytest.mark.parametrize("preset", ["circle-8", "p3dx-16"])
def test_any_ring_can_be_driven(preset: str) -> None:
    ring = RING_PRESETS[preset]
    log = simulate("paper", tour="localization", ring=ring, config=SHORT)
    assert log.ring == ring
    assert 0.3 < np.isfinite(log.ranges).mean() < 1.0


def test_a_kidnapped_robot_is_elsewhere_at_once_and_does_not_know() -> None:
    log = simulate("paper", seed=2, tour="localization", kidnap=True, config=SHORT)
    steps = np.hypot(*np.diff(truth_poses(log)[:, :2], axis=0).T)
    assert (steps > 1.0).sum() == 1
    assert steps.max() >= 3.0
    assert np.hypot(*np.diff(log.odometry[:, :2], axis=0).T).max() < 0.1


def test_a_jump_is_in_the_odometry_only() -> None:
    log = simulate("paper", seed=2, tour="localization", jump=1.0, config=SHORT)
    assert np.hypot(*np.diff(truth_poses(log)[:, :2], axis=0).T).max() < 0.1
    assert np.hypot(*np.diff(log.odometry[:, :2], axis=0).T).max() == pytest.approx(1.0, abs=0.1)


def test_a_spin_stays_where_it_is() -> None:
    log = simulate("hall", tour="spin")
    assert np.ptp(truth_poses(log)[:, :2], axis=0).max() == 0.0
    assert np.abs(np.diff(np.unwrap(truth_poses(log)[:, 2]))).sum() > 9 * np.pi


def test_in_a_changed_home_a_seat_is_gone_and_a_door_is_shut(paper: Home) -> None:
    after = changed_home(paper, 4)
    assert "armchair" not in {piece.name for piece in after.furniture}
    assert len(after.shut) == 1
    chairs = {p.name: p.footprint for p in paper.furniture if p.kind == "chair"}
    left = {p.name: p.footprint for p in after.furniture if p.kind == "chair"}
    assert left != chairs


def test_a_drive_in_a_changed_home_passes_no_shut_door(paper: Home) -> None:
    after = changed_home(paper, 4)
    log = simulate(
        paper,
        seed=4,
        tour="localization",
        changed=True,
        config=DriveConfig(localization_length=(15.0, 15.0)),
    )
    (name,) = after.shut
    gap = after.door(name).gap
    x, y = truth_poses(log)[:, 0], truth_poses(log)[:, 1]
    assert not ((x > gap.x0) & (x < gap.x1) & (y > gap.y0) & (y < gap.y1)).any()


def test_progress_is_told_and_ends_at_one() -> None:
    told: list[float] = []
    simulate(
        "paper",
        tour="localization",
        config=SHORT,
        progress=lambda share, what: told.append(share),
    )
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_wrong_arguments_are_refused_in_one_line() -> None:
    with pytest.raises(UsageError, match="tour 'swim'"):
        simulate("paper", tour="swim")  # type: ignore[arg-type]
    with pytest.raises(UsageError, match="odometry 'good'"):
        simulate("paper", odometry="good")
    with pytest.raises(UsageError, match="seed"):
        simulate("paper", seed=-1)
    giant = SonarRing(RING_PRESETS["circle-8"].sonars, robot_radius=2.5)
    with pytest.raises(InputError, match="cannot drive"):
        simulate(build_home("paper"), ring=giant)
