"""Extruded meshes: closed, outward, and as large as what they stand for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from app.viewer.contour_mesh import Mesh, extrude, greedy_rectangles
from core.mapping.occupancy_grid import GridGeometry


def area(mesh: Mesh) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, k]].astype(float) for k in range(3))
    return float(np.cross(b - a, c - a)[:, 2].sum() / 2)


def blurred(mask: np.ndarray) -> np.ndarray:
    return ndimage.gaussian_filter(mask.astype(float), 0.8, mode="constant")


@given(arrays(bool, st.tuples(st.integers(1, 9), st.integers(1, 9))))
@settings(max_examples=60, deadline=None)
def test_greedy_rectangles_cover_a_mask_exactly_once(mask):
    covered = np.zeros(mask.shape, int)
    for r0, c0, r1, c1 in greedy_rectangles(mask):
        covered[r0:r1, c0:c1] += 1
    assert (covered == mask).all()


def test_a_filled_rectangle_is_one_rectangle():
    mask = np.zeros((6, 8), bool)
    mask[1:5, 2:7] = True
    assert greedy_rectangles(mask).tolist() == [[1, 2, 5, 7]]


def test_the_cap_is_as_large_as_the_area_above_the_level():
    mask = np.zeros((40, 60), bool)
    mask[10:30, 10:50] = True
    body = extrude(blurred(mask), 0.5, 1.2, GridGeometry(0.05, (0.0, 0.0, 0.0), mask.shape))
    assert area(body.cap) == pytest.approx(20 * 40 * 0.05**2, rel=0.02)
    assert set(body.cap.vertices[:, 2].tolist()) == {np.float32(1.2)}


def test_the_body_stands_where_its_cells_are():
    mask = np.zeros((20, 20), bool)
    mask[5:15, 5:15] = True
    geometry = GridGeometry(0.1, (3.0, -2.0, 0.0), mask.shape)
    low, high = (
        edge(extrude(blurred(mask), 0.5, 1.0, geometry).sides.vertices[:, :2], axis=0)
        for edge in (np.min, np.max)
    )
    assert low == pytest.approx([3.5, -1.5], abs=0.03)
    assert high == pytest.approx([4.5, -0.5], abs=0.03)


def test_the_sides_are_closed_and_face_outwards():
    mask = np.zeros((30, 30), bool)
    mask[8:22, 8:22] = True
    geometry = GridGeometry(0.05, (0.0, 0.0, 0.0), mask.shape)
    sides = extrude(blurred(mask), 0.5, 1.0, geometry).sides
    vertices = sides.vertices.astype(float)
    edges = np.sort(
        np.concatenate([sides.faces[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 0))]), axis=1
    )
    counts = np.unique(edges, axis=0, return_counts=True)[1]
    rim = 2 * (len(vertices) // 2)
    assert (counts == 1).sum() == rim
    a, b, c = (vertices[sides.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    middle = geometry.world_of(np.array([14.5, 14.5]))
    outward = (a + b + c)[:, :2] / 3 - middle
    assert ((normals[:, :2] * outward).sum(axis=1) > 0).all()


def test_a_hole_has_sides_of_its_own():
    mask = np.zeros((40, 40), bool)
    mask[5:35, 5:35] = True
    solid = extrude(blurred(mask), 0.5, 1.0, GridGeometry(0.05, (0.0, 0.0, 0.0), mask.shape))
    mask[15:25, 15:25] = False
    ring = extrude(blurred(mask), 0.5, 1.0, GridGeometry(0.05, (0.0, 0.0, 0.0), mask.shape))
    assert area(ring.cap) == pytest.approx((900 - 100) * 0.05**2, rel=0.02)
    assert len(ring.sides.faces) > len(solid.sides.faces)


def test_a_body_at_the_grids_edge_is_closed_too():
    geometry = GridGeometry(0.05, (0.0, 0.0, 0.0), (10, 10))
    body = extrude(np.ones((10, 10)), 0.5, 1.0, geometry)
    assert area(body.cap) == pytest.approx(0.25, rel=0.06)
    assert not body.sides.empty


def test_nothing_above_the_level_is_an_empty_mesh():
    body = extrude(np.zeros((5, 5)), 0.5, 1.0, GridGeometry(0.05, (0.0, 0.0, 0.0), (5, 5)))
    assert body.cap.empty
    assert body.sides.empty


def test_the_mesh_of_a_turned_grid_turns_with_it():
    mask = np.zeros((20, 20), bool)
    mask[5:15, 5:15] = True
    straight = extrude(blurred(mask), 0.5, 1.0, GridGeometry(0.1, (0.0, 0.0, 0.0), mask.shape))
    turned = extrude(blurred(mask), 0.5, 1.0, GridGeometry(0.1, (0.0, 0.0, np.pi / 2), mask.shape))
    x, y, z = straight.cap.vertices.T
    assert turned.cap.vertices == pytest.approx(np.column_stack((-y, x, z)), abs=1e-5)
