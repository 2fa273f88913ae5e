"""How well the readings of a segment fit every pose of a grid: coarse to fine.

The score of a pose is the sum of the log-likelihood ratios of all readings, each looked up in the
table of expected ranges at the place and direction its sonar has if the robot is at that pose.

A coarse pass scores a sparse sample of the poses with every other reading and a broad likelihood;
only blocks of poses that the coarse score and the prior keep in play are then scored in full.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba
import numpy as np
import numpy.typing as npt

from core.geometry import BoolArray, IntArray
from core.localization.expected_range import ByteArray
from core.localization.pose_grid import MassArray, PoseGrid
from core.localization.segment import Segment
from core.localization.sonar_likelihood import Table

ScoreArray = npt.NDArray[np.float32]
BLOCK = 4
"""Cells along the side of a block of places."""
TURN = 3
"""Headings of a block; the middle one stands for them in the coarse pass."""
COARSE = 2
"""The coarse pass takes every COARSE-th cell in both directions and every COARSE-th reading."""
PRODUCT = 8
"""Ratios that are multiplied before a logarithm is taken; float32 holds the product of so many."""
FAINT = 1e-30
"""Prior mass below which a block is as good as empty."""


@dataclass(frozen=True)
class ObservationConfig:
    """What is scored in full.

    Attributes:
        in_play: blocks whose coarse log-posterior is this far below the best are left out; scores
            are tempered by `temper` for that.
        share: at most this share of the blocks is scored in full,
        at_least: but always this many may be.
    """

    temper: float = 0.2
    in_play: float = 12.0
    share: float = 0.15
    at_least: int = 1500


@dataclass(frozen=True)
class SonarTables:
    """One kind of sonar in one map.

    Attributes:
        codes: (directions, rows, cols, 2) expected range codes: nearest in the beam, on its axis.
        table: likelihood ratios of its readings; broad: the same for the coarse pass.
    """

    codes: ByteArray
    table: Table
    broad: Table


@dataclass(frozen=True)
class Blocks:
    """Blocks of places that hold ground to stand on.

    Attributes:
        corners: (B, 2) first row and column.
        samples: (B, 4, 2) cells that stand for the block in the coarse pass; row -1 = none.
    """

    corners: IntArray
    samples: IntArray


def blocks_of(standable: BoolArray) -> Blocks:
    """Cuts the standable cells (rows, cols) into blocks."""
    corners, samples = [], []
    for row in range(0, standable.shape[0], BLOCK):
        for col in range(0, standable.shape[1], BLOCK):
            cells = np.argwhere(standable[row : row + BLOCK, col : col + BLOCK])
            if len(cells) == 0:
                continue
            sparse = cells[(cells % COARSE == 1).all(axis=1)]
            chosen = np.full(((BLOCK // COARSE) ** 2, 2), -1)
            sparse = sparse if len(sparse) else cells[:1]
            chosen[: len(sparse)] = sparse + np.array([row, col])
            corners.append((row, col))
            samples.append(chosen)
    if not corners:
        return Blocks(np.zeros((0, 2), np.int64), np.zeros((0, 4, 2), np.int64))
    return Blocks(np.array(corners, np.int64), np.array(samples, np.int64))


def score_poses(
    segment: Segment,
    kinds: tuple[SonarTables, ...],
    kind_of_sonar: IntArray,
    grid: PoseGrid,
    blocks: Blocks,
    prior: MassArray,
    config: ObservationConfig,
) -> ScoreArray:
    """The log-likelihood ratio of a segment at every pose (headings, rows, cols), not tempered.

    Args:
        segment: the readings.
        kinds: the kinds of sonar.
        kind_of_sonar: (S,) which kind each sonar of the ring is.
        grid: the poses; `blocks`: its blocks.
        prior: (headings, rows, cols) the belief before the readings.
        config: what is scored in full.
    """
    groups = -(-grid.headings // TURN)
    kind = kind_of_sonar[segment.sonar]
    middle = np.minimum(np.arange(groups) * TURN + TURN // 2, grid.headings - 1)
    coarse = np.zeros((groups, len(blocks.corners)), np.float32)
    for k, sonar in enumerate(kinds):
        some = np.flatnonzero(kind == k)[::COARSE]
        offsets = _offsets(segment, some, grid, sonar.codes.shape[0], middle)
        _score_samples(
            sonar.codes, sonar.broad, segment.codes[some], offsets, blocks.samples, coarse
        )
    coarse *= COARSE
    active = _in_play(coarse, blocks.corners, prior, config)
    score = np.full(prior.shape, np.float32(-np.inf))
    _fill(score, coarse, blocks.corners, active)
    for k, sonar in enumerate(kinds):
        own = np.flatnonzero(kind == k)
        offsets = _offsets(segment, own, grid, sonar.codes.shape[0], np.arange(grid.headings))
        _score_blocks(
            sonar.codes, sonar.table, segment.codes[own], offsets, blocks.corners, active, score
        )
    return score


def _in_play(
    coarse: ScoreArray, corners: IntArray, prior: MassArray, config: ObservationConfig
) -> IntArray:
    """Blocks worth scoring in full: (K, 2) of heading group and block."""
    if coarse.size == 0:
        return np.zeros((0, 2), np.int64)
    value = config.temper * coarse + np.log(np.maximum(_block_maximum(prior, corners), FAINT))
    most = max(config.at_least, round(config.share * value.size))
    lowest = float(value.max()) - config.in_play
    if value.size > most:
        lowest = max(lowest, float(np.partition(value.ravel(), -most)[-most]))
    return np.argwhere(value >= lowest)


def _offsets(
    segment: Segment, readings: IntArray, grid: PoseGrid, directions: int, headings: IntArray
) -> IntArray:
    """(headings, readings, 3): row and column shift and direction of the sonars at each heading."""
    angle = headings[:, None] * grid.heading_step
    x, y, heading = segment.x[readings], segment.y[readings], segment.heading[readings]
    cell = grid.geometry.resolution
    cols = np.round((np.cos(angle) * x - np.sin(angle) * y) / cell)
    rows = np.round((np.sin(angle) * x + np.cos(angle) * y) / cell)
    turns = np.round((angle + heading) / (2 * math.pi / directions)) % directions
    return np.stack((rows, cols, turns), axis=-1).astype(np.int64)


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _score_samples(
    codes: ByteArray,
    table: Table,
    readings: IntArray,
    offsets: IntArray,
    samples: IntArray,
    out: ScoreArray,
) -> None:
    """Adds to `out` (groups, blocks) the best score among the samples of each block."""
    rows, cols = codes.shape[1:3]
    for g in range(out.shape[0]):
        for b in range(out.shape[1]):
            best = np.float32(-np.inf)
            for s in range(samples.shape[1]):
                if samples[b, s, 0] < 0:
                    break
                total, product = np.float32(0), np.float32(1)
                for k in range(readings.size):
                    r = samples[b, s, 0] + offsets[g, k, 0]
                    c = samples[b, s, 1] + offsets[g, k, 1]
                    ratio = table[readings[k], 0, 0] + table[readings[k], 1, 0]
                    if 0 <= r < rows and 0 <= c < cols:
                        seen = codes[offsets[g, k, 2], r, c]
                        ratio = table[readings[k], 0, seen[0]] + table[readings[k], 1, seen[1]]
                    product *= ratio
                    if k % PRODUCT == PRODUCT - 1 or k == readings.size - 1:
                        total += math.log(product)
                        product = np.float32(1)
                best = max(best, total)
            out[g, b] += best


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _score_blocks(
    codes: ByteArray,
    table: Table,
    readings: IntArray,
    offsets: IntArray,
    corners: IntArray,
    active: IntArray,
    score: ScoreArray,
) -> None:
    """Adds the readings of one kind of sonar to the scores of the active blocks."""
    headings, rows, cols = score.shape
    product = np.ones((BLOCK, BLOCK), np.float32)
    for a in range(len(active)):
        row, col = corners[active[a, 1]]
        for h in range(active[a, 0] * TURN, min(active[a, 0] * TURN + TURN, headings)):
            for k in range(readings.size):
                r, c = row + offsets[h, k, 0], col + offsets[h, k, 1]
                ratio, seen = table[readings[k]], codes[offsets[h, k, 2]]
                if r >= 0 and c >= 0 and r + BLOCK <= rows and c + BLOCK <= cols:
                    for i in range(BLOCK):
                        for j in range(BLOCK):
                            near, axis = seen[r + i, c + j]
                            product[i, j] *= ratio[0, near] + ratio[1, axis]
                else:
                    for i in range(BLOCK):
                        for j in range(BLOCK):
                            near, axis = np.uint8(0), np.uint8(0)
                            if 0 <= r + i < rows and 0 <= c + j < cols:
                                near, axis = seen[r + i, c + j]
                            product[i, j] *= ratio[0, near] + ratio[1, axis]
                if k % PRODUCT == PRODUCT - 1 or k == readings.size - 1:
                    for i in range(min(BLOCK, rows - row)):
                        for j in range(min(BLOCK, cols - col)):
                            score[h, row + i, col + j] += math.log(product[i, j])
                    product[:] = 1


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _block_maximum(mass: MassArray, corners: IntArray) -> ScoreArray:
    """The largest mass of every block: (groups, blocks)."""
    headings, rows, cols = mass.shape
    groups = -(-headings // TURN)
    out = np.zeros((groups, len(corners)), np.float32)
    for h in range(headings):
        for b in range(len(corners)):
            row, col = corners[b]
            for r in range(row, min(row + BLOCK, rows)):
                for c in range(col, min(col + BLOCK, cols)):
                    out[h // TURN, b] = max(out[h // TURN, b], mass[h, r, c])
    return out


@numba.njit(cache=True, nogil=True)  # type: ignore[untyped-decorator,unused-ignore]
def _fill(score: ScoreArray, coarse: ScoreArray, corners: IntArray, active: IntArray) -> None:
    """Gives every pose the coarse score of its block, and 0 where the full score is to come."""
    headings, rows, cols = score.shape
    value = coarse.copy()
    for a in range(len(active)):
        value[active[a, 0], active[a, 1]] = 0
    for h in range(headings):
        for b in range(len(corners)):
            row, col = corners[b]
            for r in range(row, min(row + BLOCK, rows)):
                for c in range(col, min(col + BLOCK, cols)):
                    score[h, r, c] = value[h // TURN, b]
