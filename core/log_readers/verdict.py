"""Whether a log is good enough for a map, in words, and what to drive next if not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.geometry import AnyArray
from core.log_readers.drive_statistics import DriveStatistics
from core.sensing.robot_log import RobotLog


@dataclass(frozen=True)
class VerdictConfig:
    """What a map needs.

    Attributes:
        scans: fewer are too few.
        distance_m: a shorter drive shows too little.
        still_m, still_rad: a robot that stays within these does not move.
        changing_m: ranges whose middle eight tenths spread over more than this tell of a robot that moves.
        spin_m, spin_rad: a robot that stays within so little and turns more spins on the spot.
        no_echo: a larger share of no echo leaves nothing to map.
        dead: a sonar with a larger share of no echo is dead ...
        dead_unless: ... unless the ring as a whole hears less than this anyway.
        stuck: a sonar of which this share of the echoes is one value is stuck ...
        stuck_echoes: ... if it has as many echoes.
        sentinel: the largest value in more than this share of readings may stand for no echo.
        step_m, step_rad: scans farther apart than this leave holes ...
        wide_percentile: ... if this percentile of the steps is, of those in which the robot moves ...
        moving_m, moving_rad: ... by more than this.
        lost_share: share of the distance driven in gaps that is too much.
        too_long_share: share of readings beyond the sonars' range that points to wrong units.
        faulty_share: share of faulty sonars that is too much.
    """

    scans: int = 50
    distance_m: float = 3.0
    still_m: float = 0.1
    still_rad: float = 0.2
    changing_m: float = 0.5
    spin_m: float = 0.5
    spin_rad: float = 3.14
    no_echo: float = 0.95
    dead: float = 0.97
    dead_unless: float = 0.85
    stuck: float = 0.9
    stuck_echoes: int = 50
    sentinel: float = 0.1
    step_m: float = 0.3
    step_rad: float = 0.45
    wide_percentile: float = 90.0
    moving_m: float = 0.01
    moving_rad: float = 0.02
    lost_share: float = 0.2
    too_long_share: float = 0.5
    faulty_share: float = 0.5


@dataclass(frozen=True)
class Remark:
    """One thing to say: whether it rules a map out, and what to do about it."""

    text: str
    rules_out: bool = False
    advice: str = ""


@dataclass(frozen=True)
class Drive:
    """What the checks look at; `too_long` is the share of readings beyond the sonars' range."""

    log: RobotLog
    steps: DriveStatistics
    too_long: float
    config: VerdictConfig


def verdict(drive: Drive) -> tuple[bool, tuple[str, ...]]:
    """Whether the log will make a map, and the sentences that say so; the first sums it up."""
    remarks = [remark for check in _CHECKS if (remark := check(drive)) is not None]
    good = not any(remark.rules_out for remark in remarks)
    remarks.sort(key=lambda remark: not remark.rules_out)
    log = drive.log
    echoes = 1 - float(np.isnan(log.ranges).mean())
    summary = (
        f"{'Good' if good else 'Not good'} enough for a map: {len(log)} scan{_s(len(log))}, "
        f"{log.distance_m:.1f} m in {log.duration_s:.0f} s, {echoes:.0%} of the readings echoed."
    )
    advice = dict.fromkeys(remark.advice for remark in remarks if remark.advice)
    return good, (summary, *(remark.text for remark in remarks), *advice)


def _few_scans(drive: Drive) -> Remark | None:
    count = len(drive.log)
    if count >= drive.config.scans:
        return None
    return Remark(
        f"There {'is' if count == 1 else 'are'} only {count} scan{_s(count)}; a map needs at least "
        f"{drive.config.scans}.",
        True,
        "Next: record a drive of at least a minute, past the walls of every room.",
    )


def _little_movement(drive: Drive) -> Remark | None:
    config, steps = drive.config, drive.steps
    turned = float(steps.radians.sum())
    if steps.extent_m < config.still_m and turned < config.still_rad:
        changing = [_spread(channel) > config.changing_m for channel in drive.log.ranges.T]
        if np.mean(changing) > config.faulty_share:
            return Remark(
                "The odometry stands still although the ranges change.",
                True,
                "Next: check that the odometry is written into the log.",
            )
        return Remark("The robot never moves.", True, _DRIVE)
    if steps.extent_m < config.spin_m and turned > config.spin_rad:
        return Remark("The robot only turns on the spot.", True, _DRIVE)
    if drive.log.distance_m < config.distance_m:
        return Remark(f"The robot drives only {drive.log.distance_m:.1f} m.", True, _DRIVE)
    return None


def _few_echoes(drive: Drive) -> Remark | None:
    if drive.too_long > drive.config.too_long_share:
        return Remark(
            f"{drive.too_long:.0%} of the ranges are beyond what the sonars can see.",
            True,
            "Next: check the units of the ranges (metres?) and the ring's max_range.",
        )
    share = float(np.isnan(drive.log.ranges).mean())
    if share <= drive.config.no_echo:
        return None
    return Remark(
        f"The sonars hardly ever echo ({share:.0%} no echo).",
        True,
        "Next: check that the sonars are switched on, and drive within a few metres of walls.",
    )


def _dead_sonars(drive: Drive) -> Remark | None:
    share = np.isnan(drive.log.ranges).mean(axis=0)
    dead = np.flatnonzero(share > drive.config.dead)
    if not len(dead) or share.mean() > drive.config.dead_unless or len(drive.log) < 2:
        return None
    return Remark(
        f"{_sonars(dead)} hardly ever {'echoes' if len(dead) == 1 else 'echo'}.",
        len(dead) > drive.config.faulty_share * len(share),
        "Next: check the wiring of the silent sonars; a map is made without them.",
    )


def _stuck_sonars(drive: Drive) -> Remark | None:
    if drive.log.distance_m < drive.config.distance_m:
        return None
    stuck = [
        i
        for i, channel in enumerate(drive.log.ranges.T)
        if _top_share(channel, drive.config.stuck_echoes) > drive.config.stuck
    ]
    if not stuck:
        return None
    return Remark(
        f"{_sonars(stuck)} always say{'s' if len(stuck) == 1 else ''} the same.",
        len(stuck) > drive.config.faulty_share * len(drive.log.ring),
        "Next: see whether something is mounted in front of the sonars that always say the same.",
    )


def _hidden_no_echo(drive: Drive) -> Remark | None:
    values = drive.log.ranges[np.isfinite(drive.log.ranges)]
    if not len(values) or drive.log.distance_m < drive.config.distance_m:
        return None
    largest = float(values.max())
    share = float((values == largest).mean())
    if share <= drive.config.sentinel:
        return None
    return Remark(
        f"{share:.0%} of the readings are exactly {largest:g} m, the largest value: "
        "if it means no echo, it must be declared so."
    )


def _wide_steps(drive: Drive) -> Remark | None:
    config, steps = drive.config, drive.steps
    moving = (steps.metres > config.moving_m) | (steps.radians > config.moving_rad)
    if not moving.any():
        return None
    far, wide = (
        float(np.percentile(step[moving], config.wide_percentile))
        for step in (steps.metres, steps.radians)
    )
    if far <= config.step_m and wide <= config.step_rad:
        return None
    what = f"{far:.2f} m" if far > config.step_m else f"{np.degrees(wide):.0f} degrees"
    return Remark(
        f"The robot is too fast for the sonars: {what} between two scans.",
        False,
        "Next: drive and turn more slowly, or log more scans a second.",
    )


def _gaps(drive: Drive) -> Remark | None:
    steps = drive.steps
    if not len(steps.gap_steps):
        return None
    lost = float(steps.metres[steps.gap_steps].sum())
    longest = float(steps.seconds[steps.gap_steps].max())
    count = len(steps.gap_steps)
    too_much = lost > drive.config.lost_share * max(drive.log.distance_m, drive.config.distance_m)
    return Remark(
        f"There {'is' if count == 1 else 'are'} {count} gap{_s(count)} without scans (the longest "
        f"{longest:.1f} s), in which the robot drove {lost:.1f} m.",
        too_much,
        "Next: find out why the logger pauses, and drive the missing parts again."
        if too_much
        else "",
    )


def _jumps(drive: Drive) -> Remark | None:
    steps = drive.steps
    if not len(steps.jump_steps):
        return None
    first = int(steps.jump_steps[0])
    count = len(steps.jump_steps)
    return Remark(
        f"The odometry jumps {count} time{_s(count)} (first at t = {drive.log.t[first + 1]:.2f} s, by "
        f"{steps.metres[first]:.2f} m and {np.degrees(steps.radians[first]):.0f} degrees); "
        "a map would be torn there.",
        True,
        "Next: split the log at the jumps, or drive again without lifting or restarting the robot.",
    )


def _latched(drive: Drive) -> Remark | None:
    share = float((~drive.log.fresh).mean())
    if share == 0:
        return None
    return Remark(f"{share:.0%} of the values only repeat an earlier measurement and are left out.")


_DRIVE = (
    "Next: drive 0.5-1 m along the walls of every room and through the doors, at about 0.2 m/s, and "
    "come back to where you started."
)
_CHECKS: tuple[Callable[[Drive], Remark | None], ...] = (
    _few_scans,
    _little_movement,
    _few_echoes,
    _dead_sonars,
    _stuck_sonars,
    _hidden_no_echo,
    _wide_steps,
    _gaps,
    _jumps,
    _latched,
)


def _spread(channel: AnyArray) -> float:
    """Distance between the first and the last tenth of the echoes of a sonar (N,); 0 without echoes."""
    values = channel[np.isfinite(channel)]
    return float(np.ptp(np.percentile(values, (10, 90)))) if len(values) else 0.0


def _top_share(channel: AnyArray, at_least: int) -> float:
    """Share of the commonest value among the echoes of a sonar (N,); 0 with fewer than `at_least`."""
    values = channel[np.isfinite(channel)]
    if len(values) < at_least:
        return 0.0
    return float(np.unique(values, return_counts=True)[1].max() / len(values))


def _sonars(indices: AnyArray | list[int]) -> str:
    names = ", ".join(str(i) for i in indices)
    return f"Sonar {names}" if len(indices) == 1 else f"Sonars {names}"


def _s(count: int) -> str:
    return "" if count == 1 else "s"
