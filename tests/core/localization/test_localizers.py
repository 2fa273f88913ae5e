"""The methods on a flat of two rooms with readings that follow from its map."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.errors import InputError, ModelError
from core.evaluation.localization import outcomes, summary
from core.geometry import FloatArray, between, wrap_angle
from core.localization.expected_range import RANGE_STEP, ExpectedRangeConfig, beam_codes, ray_codes
from core.localization.localization_step import LocalizationStep
from core.pipeline.localizer import LocalizationOptions, Localizer, localize_log
from core.sensing import RING_PRESETS, RobotLog
from core.topology import Model

RING = RING_PRESETS["paper-12"]
ROUND = (
    (1.6, 0.9),
    (1.0, 2.2),
    (3.0, 2.2),
    (3.2, 1.5),
    (5.0, 1.5),
    (6.3, 0.7),
    (6.3, 2.3),
    (4.8, 1.5),
)


def path_through(corners: tuple[tuple[float, float], ...]) -> FloatArray:
    """Poses every 10 cm along straight lines between corners."""
    poses = []
    for (x0, y0), (x1, y1) in itertools.pairwise(corners):
        length = math.hypot(x1 - x0, y1 - y0)
        heading = math.atan2(y1 - y0, x1 - x0)
        shares = np.arange(0, length, 0.1) / length
        poses += [(x0 + s * (x1 - x0), y0 + s * (y1 - y0), heading) for s in shares]
    return np.array(poses)


def drive(model: Model, poses: FloatArray) -> RobotLog:
    """A log whose readings are what the map leads one to expect; odometry starts at 0."""
    config = ExpectedRangeConfig()
    rays = ray_codes(model.grid, config)
    codes = beam_codes(rays, RING.sonars[0].beam_width, config)
    ranges = np.full((len(poses), len(RING)), np.nan)
    for i, (x, y, heading) in enumerate(poses):
        for s, sonar in enumerate(RING.sonars):
            a = heading + math.atan2(sonar.y, sonar.x)
            r = math.hypot(sonar.x, sonar.y)
            row, col = rays.geometry.cell_of((x + r * math.cos(a), y + r * math.sin(a)))
            turn = round((heading + sonar.heading) / (2 * math.pi / 144)) % 144
            seen = int(codes[turn, row, col] & 127) * RANGE_STEP
            if seen <= sonar.max_range:
                ranges[i, s] = seen
    t = np.arange(len(poses)) * 0.25
    odometry = between(poses[0], poses)
    return RobotLog("round", RING, t, odometry, ranges, np.ones(ranges.shape, bool), poses)


@pytest.fixture(scope="module")
def log(two_rooms: Model) -> RobotLog:
    return drive(two_rooms, path_through(ROUND))


def localized(
    model: Model, log: RobotLog, options: LocalizationOptions | None = None
) -> list[LocalizationStep]:
    return list(localize_log(model, log, options))


def test_default_finds_the_room_from_anywhere(two_rooms: Model, log: RobotLog) -> None:
    steps = localized(two_rooms, log)
    assert log.truth is not None
    score = summary([outcomes(steps, two_rooms, log.t, log.truth)])
    assert score.steps == len(steps) == 5
    assert score.accuracy == 1.0
    assert score.converged_m <= 5.1
    end, true = steps[-1].pose, log.truth[-1]
    assert np.hypot(*(end[:2] - true[:2])) < 0.1
    assert abs(float(wrap_angle(end[2] - true[2]))) < math.radians(4)


@pytest.mark.parametrize("method", ["default", "paper", "mcl"])
def test_every_method_tells_probabilities_that_sum_to_one(
    two_rooms: Model, log: RobotLog, method: str
) -> None:
    options = LocalizationOptions(method, particles=300)  # type: ignore[arg-type]
    for step in localized(two_rooms, log, options):
        told = step.as_dict()
        total = sum(told["probabilities"].values()) + told["unknown"]
        assert total == pytest.approx(1.0, abs=1e-4)
        assert set(told["probabilities"]) == {n.id for n in two_rooms.topology.nodes}
        assert told["best"] == max(told["probabilities"], key=told["probabilities"].get)
        assert 0 <= told["entropy"] <= 1
        assert told["t"] in log.t


def test_names_are_used_in_the_reason(two_rooms: Model, log: RobotLog) -> None:
    assert "kitchen" in localized(two_rooms, log)[-1].why


HALL_ROUND = ((0.85, 0.75), (5.15, 0.75), (5.15, 2.25), (0.85, 2.25)) * 3


def test_halves_that_look_the_same_are_told_apart_by_no_flaw_of_the_map(
    hall: Model, hall_with_a_flaw: Model
) -> None:
    steps = localized(hall_with_a_flaw, drive(hall, path_through(HALL_ROUND)))
    assert len(steps) >= 12
    assert max(max(step.probabilities.values()) for step in steps) < 0.7
    assert all("looks the same as" in step.why for step in steps[:4])


def test_halves_of_which_one_has_a_cupboard_are_told_apart(hall_with_a_cupboard: Model) -> None:
    log = drive(hall_with_a_cupboard, path_through(HALL_ROUND))
    steps = localized(hall_with_a_cupboard, log)
    assert log.truth is not None
    end, true = steps[-1].pose, log.truth[int(np.searchsorted(log.t, steps[-1].t))]
    assert max(steps[-1].probabilities.values()) > 0.9
    assert np.hypot(*(end[:2] - true[:2])) < 0.3


def test_noise_without_any_home_in_it_is_unknown(two_rooms: Model, log: RobotLog) -> None:
    readings = np.random.default_rng(5).uniform(0.3, 4.0, log.ranges.shape)
    steps = localized(two_rooms, replace(log, ranges=readings))
    assert steps[-1].unknown > 0.9


def test_a_kidnapped_robot_is_found_again(two_rooms: Model) -> None:
    west = path_through(((0.6, 1.2), (3.4, 1.2), (3.4, 2.6), (0.6, 2.6), (0.6, 1.2)))
    east = path_through(((4.6, 0.5), (6.6, 0.5), (6.6, 2.5), (4.6, 2.5), (4.6, 0.5)))
    first, second = drive(two_rooms, west), drive(two_rooms, east)
    start = first.odometry[-1]
    cos, sin = np.cos(start[2]), np.sin(start[2])
    moved = second.odometry.copy()
    moved[:, 0] = start[0] + cos * second.odometry[:, 0] - sin * second.odometry[:, 1]
    moved[:, 1] = start[1] + sin * second.odometry[:, 0] + cos * second.odometry[:, 1]
    moved[:, 2] = wrap_angle(second.odometry[:, 2] + start[2])
    both = RobotLog(
        "kidnap",
        RING,
        np.arange(len(west) + len(east)) * 0.25,
        np.concatenate((first.odometry, moved)),
        np.concatenate((first.ranges, second.ranges)),
        np.ones((len(west) + len(east), len(RING)), bool),
    )
    steps = localized(two_rooms, both)
    kitchen = next(n.id for n in two_rooms.topology.nodes if n.label == "kitchen")
    before = [s for s in steps if s.t < len(west) * 0.25]
    assert before[-1].best != kitchen
    assert steps[-1].probabilities[kitchen] > 0.9


@pytest.mark.parametrize("value", [np.nan, 0.0, 50.0])
def test_readings_that_say_nothing_do_no_harm(
    two_rooms: Model, log: RobotLog, value: float
) -> None:
    for step in localized(two_rooms, replace(log, ranges=np.full(log.ranges.shape, value))):
        assert np.isfinite(list(step.probabilities.values())).all()
        assert sum(step.probabilities.values()) + step.unknown == pytest.approx(1.0, abs=1e-4)


@settings(max_examples=6, deadline=None)
@given(st.integers(0, 10_000), st.sampled_from([0.0, 1.0, 100.0]))
def test_probabilities_are_finite_and_sum_to_one_whatever_comes_in(
    two_rooms: Model, log: RobotLog, seed: int, leap: float
) -> None:
    rng = np.random.default_rng(seed)
    odd = rng.choice([np.nan, 0.0, 0.02, 1.0, 3.99, 50.0, 1e6], log.ranges.shape)
    leaps = np.cumsum(rng.normal(0, leap, log.odometry.shape), axis=0)
    hostile = replace(log, ranges=odd, odometry=log.odometry + leaps)
    for step in localized(two_rooms, hostile.slice(0, 40)):
        told = np.array([*step.probabilities.values(), step.unknown])
        assert np.isfinite(told).all()
        assert (told >= 0).all()
        assert told.sum() == pytest.approx(1.0, abs=1e-4)
        assert np.isfinite(step.pose).all()


def test_latched_readings_are_not_read(two_rooms: Model, log: RobotLog) -> None:
    stale = replace(log, fresh=np.zeros(log.fresh.shape, bool))
    assert not any(step.updated for step in localized(two_rooms, stale))


def test_scan_by_scan_gives_what_the_batch_gives(two_rooms: Model, log: RobotLog) -> None:
    localizer = Localizer(two_rooms, RING)
    state, live = localizer.start(), []
    for scan in log:
        state, step = localizer.advance(state, scan)
        live += [step.as_dict()] if step else []
    batch = [step.as_dict() for step in localized(two_rooms, log)]
    assert live == batch[: len(live)]
    assert len(live) >= len(batch) - 1


def test_a_kept_state_goes_on_as_if_nothing_had_happened(two_rooms: Model, log: RobotLog) -> None:
    localizer = Localizer(two_rooms, RING)
    state = localizer.start()
    for i in range(60):
        state, _ = localizer.advance(state, log.scan(i))
    kept = state
    ends = []
    for _ in range(2):
        state = kept
        for i in range(60, 110):
            state, step = localizer.advance(state, log.scan(i))
            if step:
                ends.append(step.as_dict())
    assert ends[: len(ends) // 2] == ends[len(ends) // 2 :]


def test_a_drive_too_short_for_a_step_still_gets_one(two_rooms: Model, log: RobotLog) -> None:
    assert len(localized(two_rooms, log.slice(0, 5))) == 1


def test_a_rejected_step_of_the_paper_keeps_the_belief(two_rooms: Model, log: RobotLog) -> None:
    options = LocalizationOptions("paper", step=0.6)
    pairs = []
    for seed in range(1, 7):
        rng = np.random.default_rng(seed)
        wrong = rng.uniform(size=log.ranges.shape) < 0.6
        readings = np.where(wrong, rng.uniform(0.3, 4.0, log.ranges.shape), log.ranges)
        steps = localized(two_rooms, replace(log, ranges=readings), options)
        pairs += [(a, b) for a, b in itertools.pairwise(steps) if not b.updated]
    assert pairs, "no step was rejected: the test needs another drive"
    for before, rejected in pairs:
        assert rejected.probabilities == before.probabilities


def test_usage_errors_say_what_to_choose(two_rooms: Model, log: RobotLog) -> None:
    with pytest.raises(InputError, match="choose default, paper or mcl"):
        LocalizationOptions("magic")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="no scan"):
        localized(two_rooms, log.slice(0, 0))
    empty = replace(two_rooms, regions=np.zeros_like(two_rooms.regions))
    with pytest.raises(ModelError, match="no regions"):
        localized(empty, log)
