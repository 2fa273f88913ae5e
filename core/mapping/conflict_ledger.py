"""What incremental CEMAL remembers: cells, readings, who reaches which tile of cells, who waits.

All of it is plain arrays, so that compiled loops work on it and a live session can be saved. The
grid grows by whole tiles; the arrays of readings grow by doubling.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

import numpy as np

from core.geometry import AnyArray, FloatArray, IntArray
from core.mapping.occupancy_grid import GridGeometry

TILE = 8
"""Cells along the side of a tile."""
LOUDEST = 8
"""Readings that a cell remembers by name; of the quieter ones it only knows how many there are."""
CHUNK = 16
"""Readings in one link of a tile's list."""
NOBODY = -1
"""No reading, cell, win or chunk."""
PHASE, LAST_OF_PHASE, NEVER = 32, 31, 96
"""Rounds of a phase, the one of them in which losers are dropped, and the end of those who survive."""
NOT_YET = -1
"""The end of a reading that is not taken in yet."""
SEGMENTS = 6
"""Wins of one reading that are remembered; more than 3 have not been seen."""
MOST_ATTACKS = 512
"""Wins against one reading that are looked at."""
MARGIN_TILES = 8
"""Tiles by which the grid grows beyond what is needed."""


class Cells(NamedTuple):
    """By flat cell number.

    Attributes:
        empty: (cells, LOUDEST) falling pressures of readings that call the cell empty while
            conflicts are judged, dropped or not.
        empty_by: (cells, LOUDEST) which readings these are.
        more: (cells,) how many others there are, all of them quieter.
        chosen: (cells,) the names are not the loudest but those that are the loudest in some round.
        stale: (cells,) the names must be chosen anew before they are used.
        watcher: (cells,) first of the readings that are out of conflict thanks to this cell.
        guard: (cells,) first win that defends the cell, as reading * SEGMENTS + number of the win.
        free: (cells,) how many readings on the map free the cell.
        loudest: (cells,) most pressure of these, where `loudest_known`.
        loudest_known: (cells,)
        arc_pressure: (cells,) summed pressure of the arcs on the map through the cell.
        arcs: (cells,) how many arcs that are.
    """

    empty: AnyArray
    empty_by: AnyArray
    more: AnyArray
    chosen: AnyArray
    stale: AnyArray
    watcher: AnyArray
    guard: AnyArray
    free: AnyArray
    loudest: AnyArray
    loudest_known: AnyArray
    arc_pressure: AnyArray
    arcs: AnyArray


class Beams(NamedTuple):
    """By reading.

    Attributes:
        pose: (M, 3) of the transducer.
        axis: (M, 3) cosine and sine of its heading, squared cosine of its half beam.
        range_m: (M,) metres.
        sonar: (M,) index in the ring.
        scan: (M,) index of the scan.
        end: (M,) round in which it is dropped; NEVER: it survives; NOT_YET: not taken in.
        opened: (M,) round from which on it is in no conflict, NEVER if there is none.
        shown: (M,) whether `Cells.free` and `Cells.arcs` have it.
        seen_at: (M,) a cell of its arc that was not free when last looked at.
        listed: (M,) whether the lists of arcs have it.
        watched: (M,) the uncovered cell of its arc if it was never in conflict.
        before, after: (M,) neighbours in the list of those who watch the same cell.
        win_count: (M,) how many wins it has.
        win_cell, win_span, win_loudness: (M, SEGMENTS) the cell that it defends, from and until
            which round, and with what pressure.
        win_before, win_after: (M, SEGMENTS) neighbours in the list of those who defend the cell.
    """

    pose: AnyArray
    axis: AnyArray
    range_m: AnyArray
    sonar: AnyArray
    scan: AnyArray
    end: AnyArray
    opened: AnyArray
    shown: AnyArray
    seen_at: AnyArray
    listed: AnyArray
    watched: AnyArray
    before: AnyArray
    after: AnyArray
    win_count: AnyArray
    win_cell: AnyArray
    win_span: AnyArray
    win_loudness: AnyArray
    win_before: AnyArray
    win_after: AnyArray


class Tiles(NamedTuple):
    """Lists, tile by tile, of readings that reach the tile, in chunks.

    Attributes:
        head: (tiles,) the newest chunk.
        stamp: (tiles,) the reading noted last.
        items: (chunks, CHUNK) readings.
        filled: (chunks,) how many of these count.
        following: (chunks,) the next older chunk.
        used: (1,) how many chunks are in use.
    """

    head: AnyArray
    stamp: AnyArray
    items: AnyArray
    filled: AnyArray
    following: AnyArray
    used: AnyArray


class Queue(NamedTuple):
    """Readings to look at again: a list per round, linked by `before` and `after` (M,).

    Attributes:
        since: (M,) the round from which on something may differ for the reading; NOBODY: not waiting.
        first, last: (rounds,) ends of the list of a round.
    """

    since: AnyArray
    before: AnyArray
    after: AnyArray
    first: AnyArray
    last: AnyArray


Table = TypeVar("Table", Cells, Beams, Tiles, Queue)


def new_cells(count: int) -> Cells:
    """Cells that nobody has spoken of."""
    return Cells(
        np.zeros((count, LOUDEST), np.float32),
        np.full((count, LOUDEST), NOBODY, np.int32),
        np.zeros(count, np.int32),
        np.zeros(count, bool),
        np.zeros(count, bool),
        np.full(count, NOBODY, np.int32),
        np.full(count, NOBODY, np.int32),
        np.zeros(count, np.int32),
        np.zeros(count),
        np.zeros(count, bool),
        np.zeros(count),
        np.zeros(count, np.int32),
    )


def new_beams(count: int) -> Beams:
    """Room for `count` readings."""
    return Beams(
        np.zeros((count, 3)),
        np.zeros((count, 3)),
        np.zeros(count),
        np.zeros(count, np.int64),
        np.zeros(count, np.int64),
        np.full(count, NOT_YET, np.int16),
        np.full(count, NEVER, np.int16),
        np.zeros(count, bool),
        np.full(count, NOBODY, np.int64),
        np.zeros(count, bool),
        np.full(count, NOBODY, np.int64),
        np.full(count, NOBODY, np.int32),
        np.full(count, NOBODY, np.int32),
        np.zeros(count, np.int8),
        np.full((count, SEGMENTS), NOBODY, np.int64),
        np.zeros((count, SEGMENTS, 2), np.int16),
        np.zeros((count, SEGMENTS), np.float32),
        np.full((count, SEGMENTS), NOBODY, np.int32),
        np.full((count, SEGMENTS), NOBODY, np.int32),
    )


def new_queue(count: int) -> Queue:
    """Nobody waits."""
    return Queue(
        np.full(count, NOBODY, np.int32),
        np.full(count, NOBODY, np.int32),
        np.full(count, NOBODY, np.int32),
        np.full(NEVER + 1, NOBODY, np.int32),
        np.full(NEVER + 1, NOBODY, np.int32),
    )


def new_tiles(tiles: int, chunks: int) -> Tiles:
    """Empty lists for `tiles` tiles, with room for `chunks` chunks."""
    return Tiles(
        np.full(tiles, NOBODY, np.int32),
        np.full(tiles, NOBODY, np.int32),
        np.zeros((chunks, CHUNK), np.int32),
        np.zeros(chunks, np.int32),
        np.full(chunks, NOBODY, np.int32),
        np.zeros(1, np.int64),
    )


def with_room(beams: Beams, count: int) -> Beams:
    """The same readings in arrays for at least `count`."""
    have = len(beams.range_m)
    if count <= have:
        return beams
    return _copied(beams, new_beams(max(count, 2 * have)))


def with_places(queue: Queue, count: int) -> Queue:
    """The same queue with room for `count` readings."""
    return queue if len(queue.since) == count else _copied(queue, new_queue(count))


def with_chunks(tiles: Tiles, wanted: int) -> Tiles:
    """The same lists with at least `wanted` unused chunks."""
    have, used = len(tiles.filled), int(tiles.used[0])
    if used + wanted <= have:
        return tiles
    grown = new_tiles(len(tiles.head), max(2 * have, used + wanted))
    for name in ("items", "filled", "following"):
        getattr(grown, name)[:have] = getattr(tiles, name)
    return grown._replace(head=tiles.head, stamp=tiles.stamp, used=tiles.used)


def moved_cells(cells: Cells, old: GridGeometry, new: GridGeometry) -> Cells:
    """The cells of a grid inside a larger one."""
    (row, col), (rows, cols) = corner_in(old, new), old.shape
    target = new_cells(new.shape[0] * new.shape[1])
    for before, after in zip(cells, target, strict=True):
        after.reshape(*new.shape, *after.shape[1:])[row : row + rows, col : col + cols] = (
            before.reshape(*old.shape, *before.shape[1:])
        )
    return target


def moved_tiles(tiles: Tiles, old: GridGeometry, new: GridGeometry) -> Tiles:
    """The lists of a grid's tiles inside a larger grid."""
    row, col = (v // TILE for v in corner_in(old, new))
    rows, cols = (v // TILE for v in old.shape)
    shape = (new.shape[0] // TILE, new.shape[1] // TILE)
    head = np.full(shape, NOBODY, np.int32)
    head[row : row + rows, col : col + cols] = tiles.head.reshape(rows, cols)
    return tiles._replace(head=head.ravel(), stamp=np.full(head.size, NOBODY, np.int32))


def moved_numbers(numbers: IntArray, old: GridGeometry, new: GridGeometry) -> IntArray:
    """Flat cell numbers of a grid as those of a larger one; NOBODY stays."""
    row, col = corner_in(old, new)
    rows, cols = np.divmod(numbers, old.shape[1])
    return np.where(numbers == NOBODY, NOBODY, (rows + row) * new.shape[1] + cols + col)


def corner_in(old: GridGeometry, new: GridGeometry) -> tuple[int, int]:
    """Row and column of the old grid's first cell in the new grid."""
    shift = (np.array(old.origin[:2]) - new.origin[:2]) / new.resolution
    col, row = np.round(shift).astype(int)
    return int(row), int(col)


def extended(geometry: GridGeometry | None, points: FloatArray, resolution: float) -> GridGeometry:
    """A grid of whole tiles that holds the old grid and the points (N, 2).

    Its corner is a multiple of the tile's side, so that grids of one world line up. Where it has to
    grow it grows by `MARGIN_TILES` more than needed.
    """
    side = TILE * resolution
    low = np.floor(points.min(axis=0) / side).astype(int) - MARGIN_TILES
    high = np.ceil(points.max(axis=0) / side).astype(int) + MARGIN_TILES
    if geometry is not None:
        old_low = np.round(np.array(geometry.origin[:2]) / side).astype(int)
        old_high = old_low + np.array(geometry.shape[::-1]) // TILE
        low = np.where(low + MARGIN_TILES >= old_low, old_low, low)
        high = np.where(high - MARGIN_TILES <= old_high, old_high, high)
    rows, cols = (high - low)[::-1] * TILE
    # the same product as GridGeometry.around, so that corners agree to the last bit
    corner = low * TILE * resolution
    return GridGeometry(
        resolution, (float(corner[0]), float(corner[1]), 0.0), (int(rows), int(cols))
    )


def _copied(source: Table, target: Table) -> Table:
    pairs: Any = zip(source, target, strict=True)
    for before, after in pairs:
        after[: len(before)] = before
    return target
