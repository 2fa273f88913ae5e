"""One log from the poses and ranges of several files."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from core.errors import LogError
from core.geometry import BoolArray, FloatArray, IntArray
from core.log_readers.draft_log import DraftLog, Finding
from core.log_readers.pose_join import poses_at
from core.log_readers.text_streams import FileStreams
from core.sensing.ring import SonarRing


def joined(format_name: str, name: str, ring: SonarRing, files: Sequence[FileStreams]) -> DraftLog:
    """The log in which every row of ranges is a scan at the pose of its time.

    Scans without a trustworthy pose are left out (see `JoinConfig`). A true pose is used only if every
    scan has one.

    Raises:
        LogError: no scan has a pose.
    """
    sonar_files = [file for file in files if len(file.sonars)]
    t, lines, ranges, too_close, fresh = _merged(sonar_files, len(ring))
    source = sonar_files[0].source
    poses, known = _poses(t, files, "poses")
    if not known.any():
        raise LogError("no row has a pose near its time; do both files use one clock?", source)
    truth, true = _poses(t, files, "truth")
    skipped = [finding for file in files for finding in file.skipped]
    if not known.all():
        skipped.append(Finding.at("no pose near that time", lines[~known], source))
    notes = []
    if true.any() and not true[known].all():
        notes.append(Finding("scans without truth; the truth is not used", int((~true).sum())))
    if too_close.any():
        notes.append(Finding("readings of something too close to measure", int(too_close.sum())))
    return DraftLog(
        format_name,
        name,
        ring,
        t[known],
        poses[known],
        ranges[known],
        lines[known],
        source,
        None if fresh is None else fresh[known],
        truth[known] if true[known].all() else None,
        tuple(skipped),
        tuple(notes),
        tuple(finding for file in files for finding in file.clock),
        too_close[known],
    )


def _merged(
    files: Sequence[FileStreams], ring_size: int
) -> tuple[FloatArray, IntArray, FloatArray, BoolArray, BoolArray | None]:
    """Times, lines, ranges (N, S), too close (N, S) and, with several files, what was measured (N, S)."""
    if len(files) == 1 and len(files[0].sonars) == ring_size:
        file = files[0]
        order = np.argsort(file.sonars)
        return file.t, file.lines, file.ranges[:, order], file.too_close[:, order], None
    t, where = np.unique(np.concatenate([file.t for file in files]), return_inverse=True)
    shape = (len(t), ring_size)
    lines = np.zeros(len(t), np.int64)
    ranges, too_close, fresh = np.full(shape, np.nan), np.zeros(shape, bool), np.zeros(shape, bool)
    start = 0
    for file in files:
        rows = where[start : start + len(file.t)]
        start += len(file.t)
        cells = np.ix_(rows, file.sonars)
        lines[rows] = file.lines
        ranges[cells], too_close[cells], fresh[cells] = file.ranges, file.too_close, True
    return t, lines, ranges, too_close, fresh


def _poses(t: FloatArray, files: Sequence[FileStreams], kind: str) -> tuple[FloatArray, BoolArray]:
    """Odometry or true poses (N, 3) at the times (N,), and which are known (N,)."""
    for file in files:
        poses: FloatArray | None = getattr(file, kind)
        if poses is not None:
            return poses_at(t, file.t, poses)
    return np.zeros((len(t), 3)), np.zeros(len(t), bool)
