"""Which poses a drive is mapped at: the odometry, the calibrated odometry, or the corrected trajectory.

What the log cannot tell is left as the odometry has it, and said. A correction is only used where it
makes the map sharper than the odometry does.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from core.geometry import FloatArray
from core.mapping.drift_config import DriftConfig
from core.mapping.drift_correction import DriftResult, correct_drift
from core.mapping.drift_edits import DriftEdits
from core.mapping.loop_closure import Closure
from core.mapping.map_sharpness import SharpnessConfig, map_sharpness
from core.mapping.odometry_breaks import (
    BreakConfig,
    BreakKind,
    OdometryBreak,
    find_breaks,
    without_jumps,
)
from core.mapping.odometry_calibration import OdometryCalibration
from core.mapping.odometry_model import OdometryNoise, without_systematic_error
from core.mapping.point_frames import points_in_world
from core.mapping.reflection_points import ReflectionPoints, path_length, reflection_points
from core.mapping.wall_direction import wall_sharpness
from core.progress import Progress, no_progress, part_of
from core.sensing.robot_log import RobotLog
from core.sensing.trajectory import Trajectory
from core.wording import counted

OdometryChoice = Literal["raw", "calibrated", "corrected"]
"""What the command line, the API and the modelling form call the three."""


@dataclass(frozen=True)
class OdometryConfig:
    """Parameters.

    Attributes:
        gain: a correction must make the map sharper by at least this factor, else the odometry stays.
        wall_gain: where no place was visited twice, sharpness says little: the walls must become
            straighter by this factor ...
        wall_loss: ... and the map not less sharp than this.
        weak_heading, weak_position: stretches whose pose is less certain than this (rad, m) are named.
    """

    gain: float = 1.04
    wall_gain: float = 1.03
    wall_loss: float = 0.9
    weak_heading: float = float(np.radians(4.0))
    weak_position: float = 0.25
    drift: DriftConfig = field(default_factory=DriftConfig)
    breaks: BreakConfig = field(default_factory=BreakConfig)
    sharpness: SharpnessConfig = field(default_factory=SharpnessConfig)

    def knowing(self, calibration: OdometryCalibration | None) -> OdometryConfig:
        """The same for a robot whose calibration is known from an earlier drive."""
        if calibration is None:
            return self
        noise = calibration.known_before(self.drift.noise)
        return replace(self, drift=replace(self.drift, noise=noise))


@dataclass(frozen=True)
class OdometryResult:
    """The poses of a drive and what was found about them.

    Attributes:
        trajectory: one pose per scan.
        used: what the trajectory is: the choice, or `raw` when that would not have helped.
        calibration: systematic errors of the odometry, unless the choice was `raw`.
        closures: places found again, accepted or not.
        breaks: jumps and carried robots.
        part: (start, stop) of the scans that belong together; a map is made of these only.
        sentences: the findings in words.
    """

    trajectory: Trajectory
    used: OdometryChoice
    calibration: OdometryCalibration | None
    closures: tuple[Closure, ...]
    breaks: tuple[OdometryBreak, ...]
    part: tuple[int, int]
    sentences: tuple[str, ...]


def trajectory_for(
    log: RobotLog,
    choice: OdometryChoice = "corrected",
    progress: Progress = no_progress,
    config: OdometryConfig | None = None,
    edits: DriftEdits | None = None,
) -> OdometryResult:
    """The poses to map a drive at.

    Args:
        log: the drive.
        choice: `raw` (the odometry as it is), `calibrated` (its systematic errors taken out) or
            `corrected`.
        progress: 0..1.
        config: parameters; `config.drift.noise` holds what is known of the robot.
        edits: what a person says about the drive. When that moves it, the correction is used in any
            case.

    Raises:
        InputError: the edits speak of another drive, or of its start.
    """
    config, edits = config or OdometryConfig(), edits or DriftEdits()
    whole = (0, len(log))
    if choice == "raw" or len(log) < 3:
        return OdometryResult(Trajectory.from_odometry(log), "raw", None, (), (), whole, ())
    log = log.without_truth()
    breaks = find_breaks(log, config.breaks, config.drift.matching)
    part = _longest_part(log, breaks)
    smooth = without_jumps(log, breaks)
    drive = smooth.slice(*part)
    result = correct_drift(drive, config.drift, part_of(progress, 0.0, 0.95), edits)
    calibrated = without_systematic_error(drive.odometry, result.calibration.error)
    options: dict[OdometryChoice, Trajectory] = {
        "raw": _uncertain(drive, drive.odometry, config.drift.noise),
        "calibrated": _uncertain(drive, calibrated, config.drift.noise, result.calibration),
        "corrected": result.trajectory,
    }
    revisited = any(closure.accepted for closure in result.closures)
    by_person = edits.decisive and choice == "corrected"
    used = choice if by_person else _best(drive, options, choice, revisited, config)
    trajectory = _whole(smooth, part, options[used])
    progress(1.0, "odometry")
    return OdometryResult(
        trajectory,
        used,
        result.calibration,
        result.closures,
        breaks,
        part,
        _findings(choice, used, breaks, part, log, result, config),
    )


def _longest_part(log: RobotLog, breaks: tuple[OdometryBreak, ...]) -> tuple[int, int]:
    """The longest stretch (in travel) during which nobody carried the robot."""
    cuts = [0, *(b.scan for b in breaks if b.kind is BreakKind.CARRIED), len(log)]
    length = path_length(log.odometry, 0.0)
    spans = [(cuts[i], cuts[i + 1]) for i in range(len(cuts) - 1) if cuts[i + 1] - cuts[i] >= 3]
    return max(spans, key=lambda s: float(length[s[1] - 1] - length[s[0]]), default=(0, len(log)))


def _best(
    drive: RobotLog,
    options: dict[OdometryChoice, Trajectory],
    choice: OdometryChoice,
    revisited: bool,
    config: OdometryConfig,
) -> OdometryChoice:
    """The choice if its map is sharper than the odometry's, else the next simpler one that is.

    The reflecting points depend a little on the poses they were found with, which then look sharper:
    a correction must win with the points of either.
    """
    order: tuple[OdometryChoice, ...] = ("corrected", "calibrated")
    by_odometry = reflection_points(drive, drive.odometry, config.drift.reflection)
    for name in order[order.index(choice) :]:
        poses = options[name].poses
        by_option = reflection_points(drive, poses, config.drift.reflection)
        gains = [
            _gains(points, poses, drive.odometry, config) for points in (by_odometry, by_option)
        ]
        sharper, straighter = (min(gain) for gain in zip(*gains, strict=True))
        by_walls = not revisited and sharper >= config.wall_loss and straighter >= config.wall_gain
        if sharper >= config.gain or by_walls:
            return name
    return "raw"


def _gains(
    points: ReflectionPoints, poses: FloatArray, odometry: FloatArray, config: OdometryConfig
) -> tuple[float, float]:
    """How much sharper the map and how much straighter its walls are at the poses than at the odometry."""
    walls, sharp = config.drift.walls, config.sharpness
    before = map_sharpness(points, odometry, sharp)
    straight = wall_sharpness(*points_in_world(points, odometry), walls)
    return (
        map_sharpness(points, poses, sharp) / before if before > 0 else 0.0,
        wall_sharpness(*points_in_world(points, poses), walls) / straight if straight > 0 else 0.0,
    )


def _uncertain(
    drive: RobotLog,
    poses: FloatArray,
    noise: OdometryNoise,
    calibration: OdometryCalibration | None = None,
) -> Trajectory:
    """Poses of (calibrated) odometry with standard deviations that grow along the drive."""
    driven = path_length(drive.odometry, 0.0)
    turned = path_length(drive.odometry, 1.0) - driven
    scale, turn, drift = noise.systematic if calibration is None else calibration.sigma
    net_turn = np.abs(np.unwrap(drive.odometry[:, 2]) - drive.odometry[0, 2])
    random = noise.heading**2 * (driven + noise.metres_per_radian * turned)
    heading = np.sqrt(random + (turn * net_turn) ** 2 + (drift * driven) ** 2)
    away = np.hypot(*(poses[:, :2] - poses[0, :2]).T)
    position = np.sqrt(
        noise.position**2 * driven + (scale * away) ** 2 + (heading * driven) ** 2 / 12
    )
    return Trajectory(drive.t, poses, position, heading)


def _whole(log: RobotLog, part: tuple[int, int], inner: Trajectory) -> Trajectory:
    """The trajectory of the whole log; outside the part it is the odometry, of unknown certainty."""
    poses = log.odometry.copy()
    sigma_xy, sigma_heading = np.full(len(log), np.inf), np.full(len(log), np.inf)
    span = slice(*part)
    poses[span], sigma_xy[span], sigma_heading[span] = (
        inner.poses,
        inner.sigma_xy,
        inner.sigma_heading,
    )
    return Trajectory(log.t, poses, sigma_xy, sigma_heading)


def _findings(
    choice: OdometryChoice,
    used: OdometryChoice,
    breaks: tuple[OdometryBreak, ...],
    part: tuple[int, int],
    log: RobotLog,
    result: DriftResult,
    config: OdometryConfig,
) -> tuple[str, ...]:
    """What to tell the user."""
    out: list[str] = []
    for b in breaks:
        if b.kind is BreakKind.JUMP:
            out.append(
                f"The odometry jumps by {b.step:.2f} m at {b.t:.1f} s while the sonar goes on as before; "
                "the jump was taken out."
            )
        else:
            out.append(
                f"At {b.t:.1f} s the sonar suddenly sees another place: the robot was carried or data is "
                "missing. The drive was split there; the parts are not joined."
            )
    if part != (0, len(log)):
        out.append(
            f"The map is made of the longest part, {log.t[part[0]]:.1f} s to {log.t[part[1] - 1]:.1f} s."
        )
    if any(config.drift.noise.expected):
        out.append("What an earlier drive told of this robot's odometry was taken into account.")
    out += result.calibration.sentences()
    accepted = sum(closure.accepted for closure in result.closures)
    out.append(_found_again(accepted, len(result.closures) - accepted))
    if used != choice:
        out.append(
            f"The {choice} odometry would not make the map sharper; "
            f"the {'odometry was kept as it is' if used == 'raw' else 'calibrated one was used'}."
        )
    return (*out, *_weak(log, part, result.trajectory, config))


def _found_again(accepted: int, rejected: int) -> str:
    """How many places closed a loop, and how many only looked as if they did."""
    if accepted + rejected == 0:
        return "No place was visited twice: only the directions of the walls speak about the drift."
    found = f"{counted(accepted, 'place')} {'was' if accepted == 1 else 'were'} found again"
    tried = f"{rejected} more {'was' if rejected == 1 else 'were'} tried and rejected"
    return f"{found} ({tried})." if rejected else f"{found}."


def _weak(
    log: RobotLog, part: tuple[int, int], trajectory: Trajectory, config: OdometryConfig
) -> tuple[str, ...]:
    """Stretches of the drive whose poses stay uncertain."""
    driven = path_length(log.odometry, 0.0)[slice(*part)]
    out = []
    for sigma, limit, what, unit in (
        (trajectory.sigma_xy, config.weak_position, "position", "m"),
        (
            np.degrees(trajectory.sigma_heading),
            np.degrees(config.weak_heading),
            "heading",
            "degrees",
        ),
    ):
        weak = np.concatenate(([False], sigma > limit, [False]))
        edges = np.flatnonzero(np.diff(weak.astype(int)))
        for start, stop in zip(edges[::2], edges[1::2], strict=True):
            out.append(
                f"The {what} is weak from {driven[start]:.0f} m to {driven[stop - 1]:.0f} m "
                f"(±{sigma[start:stop].max():.2g} {unit})."
            )
    return tuple(out)
