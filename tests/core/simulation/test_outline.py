"""The outline of solid things: faces, normals, edges."""

from __future__ import annotations

import numpy as np
import pytest

from core.simulation.floor_plan import Box, Room
from core.simulation.furniture import Disc, Piece, piece
from core.simulation.home import Home
from core.simulation.outline import Outline, outline_of

HALL = Room("hall", "hall", (Box(0, 0, 8, 6),))
INNER_PERIMETER = 2 * (8 - 0.2) + 2 * (6 - 0.2)
OUTER_PERIMETER = 2 * (8 + 0.2) + 2 * (6 + 0.2)


def outline(*pieces: Piece) -> Outline:
    return outline_of(Home("hall", (HALL,), (), pieces))


def lengths(o: Outline) -> np.ndarray:
    return np.hypot(o.faces[:, 2] - o.faces[:, 0], o.faces[:, 3] - o.faces[:, 1])


def test_an_empty_hall_has_the_faces_of_its_walls_and_only_outer_edges() -> None:
    o = outline()
    assert lengths(o).sum() == pytest.approx(INNER_PERIMETER + OUTER_PERIMETER)
    inside = (o.edges[:, 0] > 0.05) & (o.edges[:, 0] < 7.95) & (o.edges[:, 1] > 0.05)
    assert len(o.edges) == 4
    assert not inside[(o.edges[:, 1] < 5.95)].any()


def test_normals_look_into_free_space() -> None:
    o = outline(piece("chest", Box(3, 2, 5, 3)))
    middle = (o.faces[:, :2] + o.faces[:, 2:]) / 2
    ahead, behind = middle + 0.01 * o.normals, middle - 0.01 * o.normals

    def solid(p: np.ndarray) -> np.ndarray:
        x, y = p[:, 0], p[:, 1]
        chest = (x > 3) & (x < 5) & (y > 2) & (y < 3)
        within = (x > -0.1) & (x < 8.1) & (y > -0.1) & (y < 6.1)
        room = (x > 0.1) & (x < 7.9) & (y > 0.1) & (y < 5.9)
        return chest | (within & ~room)

    assert not solid(ahead).any()
    assert solid(behind).all()


def test_furniture_against_a_wall_hides_the_wall_behind_it() -> None:
    o = outline(piece("chest", Box(3, 0.1, 5, 0.6)))
    assert lengths(o).sum() == pytest.approx(INNER_PERIMETER + OUTER_PERIMETER + 2 * 0.5)


def test_a_free_standing_box_has_four_convex_edges() -> None:
    o = outline(piece("chest", Box(3, 2, 5, 3)))
    corners = {(3.0, 2.0), (5.0, 2.0), (3.0, 3.0), (5.0, 3.0)}
    assert corners <= {tuple(edge) for edge in o.edges.tolist()}


def test_a_round_table_has_outward_normals() -> None:
    table = piece("round table", Box(3.5, 2.5, 4.5, 3.5))
    assert table.solids == (Disc(4.0, 3.0, 0.5),)
    o = outline(table)
    middle = (o.faces[:, :2] + o.faces[:, 2:]) / 2
    off = middle - (4.0, 3.0)
    mine = np.hypot(*off.T) < 0.51
    assert mine.sum() == 24
    assert (np.einsum("ij,ij->i", off[mine], o.normals[mine]) > 0.49).all()


def test_shutting_a_door_leaves_the_other_walls_as_they_are(paper: Home) -> None:
    before = outline_of(paper)
    after = outline_of(paper.with_shut("door 1"))
    far = before.faces[:, 0] > 4.5
    known = {tuple(row) for row in np.hstack((after.faces, after.surfaces)).tolist()}
    assert all(
        tuple(row) in known for row in np.hstack((before.faces, before.surfaces))[far].tolist()
    )
