"""What the report says of drives that are no good, and of good ones."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from core.log_readers import LogReport
from core.log_readers.acceptance import accept
from core.log_readers.draft_log import DraftLog
from core.sensing import RING_PRESETS

RING = RING_PRESETS["circle-8"]
DRIVE_ALONG_WALLS = "Next: drive 0.5-1 m along the walls"


def drive(count: int = 400) -> DraftLog:
    """Eight sonars on a robot that drives 0.05 m a scan round a square of 5 m, at 4 Hz."""
    way = np.arange(count) * 0.05
    side, along = np.divmod(way, 5.0)
    corner = np.array([(0, 0), (5, 0), (5, 5), (0, 5)])[side.astype(int) % 4]
    heading = side * np.pi / 2
    position = corner + along[:, None] * np.stack((np.cos(heading), np.sin(heading)), axis=1)
    rng = np.random.default_rng(0)
    ranges = np.round(1.5 + np.sin(way)[:, None] * 0.5 + rng.normal(0, 0.05, (count, 8)), 3)
    ranges[rng.random(ranges.shape) < 0.1] = np.nan
    return DraftLog(
        "made up", "square", RING, np.arange(count) * 0.25, np.column_stack((position, heading)),
        ranges, np.arange(count) + 2, "square.jsonl",
    )  # fmt: skip


def report(draft: DraftLog) -> LogReport:
    return accept(draft).report


def text(draft: DraftLog) -> str:
    return " ".join(report(draft).verdict)


def test_a_good_drive_is_good_and_nothing_else_is_said() -> None:
    result = report(drive())
    assert result.good_for_map
    assert result.verdict == (
        "Good enough for a map: 400 scans, 20.0 m in 100 s, 89% of the readings echoed.",
    )
    assert result.scans == 400
    assert result.sonars == 8
    assert result.duration_s == pytest.approx(99.75)
    assert result.distance_m == pytest.approx(19.95, abs=0.1)
    assert result.turn_rad == pytest.approx(3 * np.pi / 2)
    assert result.extent_m == pytest.approx(5 * np.sqrt(2), abs=0.05)
    assert result.rate_hz == pytest.approx(4)
    assert result.no_echo == pytest.approx(np.mean(result.no_echo_per_sonar))
    assert (result.gap_count, result.jump_count, result.latched) == (0, 0, 0)


def still(draft: DraftLog) -> DraftLog:
    ranges = draft.ranges - np.sin(np.arange(400) * 0.05)[:, None] * 0.5
    return replace(draft, odometry=np.zeros((400, 3)), ranges=ranges)


def frozen_odometry(draft: DraftLog) -> DraftLog:
    return replace(still(draft), ranges=draft.ranges + np.arange(400)[:, None] / 200)


def spinning(draft: DraftLog) -> DraftLog:
    poses = np.zeros((len(draft.t), 3))
    poses[:, 2] = np.arange(len(poses)) * 0.1
    return replace(draft, odometry=poses)


def short(draft: DraftLog) -> DraftLog:
    return replace(draft, odometry=draft.odometry * (0.1, 0.1, 1))


def silent(draft: DraftLog) -> DraftLog:
    return replace(draft, ranges=np.full(draft.ranges.shape, np.nan))


def millimetres(draft: DraftLog) -> DraftLog:
    return replace(draft, ranges=draft.ranges * 1000)


def mostly_dead(draft: DraftLog) -> DraftLog:
    ranges = draft.ranges.copy()
    ranges[:, :5] = np.nan
    return replace(draft, ranges=ranges)


def lifted(draft: DraftLog) -> DraftLog:
    poses = draft.odometry.copy()
    poses[200:] += (3, 0, 0)
    return replace(draft, odometry=poses)


def full_of_gaps(draft: DraftLog) -> DraftLog:
    keep = np.arange(len(draft.t)) % 100 < 60
    return replace(
        draft, t=draft.t[keep], odometry=draft.odometry[keep], ranges=draft.ranges[keep],
        lines=draft.lines[keep],
    )  # fmt: skip


@pytest.mark.parametrize(
    ("spoil", "sentence", "advice"),
    [
        (lambda d: drive(1), "There is only 1 scan; a map needs at least 50.", "at least a minute"),
        (still, "The robot never moves.", DRIVE_ALONG_WALLS),
        (frozen_odometry, "The odometry stands still although the ranges change.", "check that"),
        (spinning, "The robot only turns on the spot.", DRIVE_ALONG_WALLS),
        (short, "The robot drives only 2.0 m.", DRIVE_ALONG_WALLS),
        (silent, "The sonars hardly ever echo (100% no echo).", "switched on"),
        (millimetres, "89% of the ranges are beyond what the sonars can see.", "check the units"),
        (mostly_dead, "Sonars 0, 1, 2, 3, 4 hardly ever echo.", "check the wiring"),
        (lifted, "The odometry jumps 1 time (first at t = 50.00 s, by 3.00 m", "split the log"),
        (full_of_gaps, "There are 3 gaps without scans (the longest 10.2 s)", "again"),
    ],
)  # fmt: skip
def test_a_drive_that_makes_no_map_says_why_and_what_to_do(
    spoil: Callable[[DraftLog], DraftLog], sentence: str, advice: str
) -> None:
    result = report(spoil(drive()))
    assert not result.good_for_map
    assert result.verdict[0].startswith("Not good enough for a map")
    assert any(part.startswith(sentence) for part in result.verdict), result.verdict
    assert any(part.startswith("Next: ") and advice in part for part in result.verdict)


def test_one_silent_sonar_is_told_but_does_not_rule_the_map_out() -> None:
    draft = drive()
    draft.ranges[:, 4] = np.nan
    result = report(draft)
    assert result.good_for_map
    assert "Sonar 4 hardly ever echoes." in result.verdict
    assert result.no_echo_per_sonar[4] == 1


def test_a_sonar_that_always_says_the_same_is_told() -> None:
    draft = drive()
    draft.ranges[:, 2] = 0.31
    assert "Sonar 2 always says the same." in text(draft)


def test_a_no_echo_value_that_nobody_declared_is_suspected() -> None:
    draft = drive()
    draft.ranges[np.isnan(draft.ranges)] = 4.0
    draft.ranges[:100] = 4.0
    assert "exactly 4 m, the largest value" in text(draft)


def test_a_robot_too_fast_for_its_sonars_is_told() -> None:
    draft = drive()
    quick = slice(None, None, 8)
    draft = replace(
        draft, t=draft.t[quick], odometry=draft.odometry[quick], ranges=draft.ranges[quick],
        lines=draft.lines[quick],
    )  # fmt: skip
    assert "too fast for the sonars: 0.40 m between two scans" in text(draft)


def test_stale_values_are_counted() -> None:
    draft = drive()
    fresh = np.ones(draft.ranges.shape, bool)
    fresh[::2, 3] = False
    result = report(replace(draft, fresh=fresh))
    assert result.latched == pytest.approx(1 / 16)
    assert result.latched_per_sonar[3] == 0.5
    assert "6% of the values only repeat an earlier measurement and are left out." in result.verdict


def test_impossible_ranges_are_named_with_their_lines() -> None:
    draft = drive()
    draft.ranges[7, :2] = (-1, 0)
    draft.ranges[9, 5] = 77
    result = report(draft)
    assert [(note.count, note.lines) for note in result.notes] == [(2, (9,)), (1, (11,))]


def test_a_report_names_few_places_and_is_plain_json() -> None:
    draft = drive()
    draft.ranges[::2, 0] = 99
    draft.odometry[::10, 0] += 5
    result = report(draft)
    assert len(result.notes[0].lines) == 10
    assert result.notes[0].count == 200
    assert (result.jump_count, len(result.jumps)) == (79, 10)
    plain = result.as_dict()
    assert json.loads(json.dumps(plain, allow_nan=False)) == plain
