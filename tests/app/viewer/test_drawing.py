"""A model as it is drawn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.viewer.canvas import Canvas, shortened, turned
from app.viewer.drawing import draw, relabelled
from app.viewer.floor_image import FloorConfig, picture_scale, smooth_labels
from app.viewer.graph_shapes import circle, icosphere, unit_box
from app.viewer.paths import path_colours, path_segments, thinned
from app.viewer.viser_server import PrivateViser
from core.mapping import OccupancyGrid
from core.mapping.occupancy_grid import GridGeometry
from core.topology import Model, TopologicalMap


@pytest.fixture(scope="module")
def drawing(two_rooms):
    return draw(two_rooms)


def test_an_edge_bends_through_its_doorway(drawing):
    assert drawing.edges[:, :, :2].tolist() == [
        [[0.1, 3.1], [1.1, 3.1]],
        [[1.1, 3.1], [2.1, 3.1]],
    ]


def test_the_outline_encloses_what_is_drawn(drawing):
    assert drawing.outline.min(axis=0) == pytest.approx((-1.0, 2.0), abs=0.06)
    assert drawing.outline.max(axis=0) == pytest.approx((3.2, 4.2), abs=0.06)


def test_the_pictures_have_the_regions_colours_and_are_clear_where_nothing_is(drawing, two_rooms):
    floor = drawing.floors["light"]
    rows, cols = two_rooms.grid.geometry.shape
    scale = floor.regions.shape[0] // rows
    assert floor.regions.shape == (rows * scale, cols * scale, 4)
    west, east = (floor.regions[22 * scale, col * scale].astype(int) for col in (20, 65))
    assert west[3] == east[3] == 255
    assert np.abs(west[:3] - east[:3]).max() > 20
    assert floor.grid[0, 0, 3] < 128
    assert (drawing.floors["dark"].regions[22 * scale, 20 * scale] != west).any()


def test_a_picture_of_a_large_map_stays_small():
    config = FloorConfig()
    assert picture_scale((175, 230), config) == 4
    for shape in ((500, 700), (2000, 1520)):
        scale = picture_scale(shape, config)
        assert scale == 1 or shape[0] * shape[1] * scale**2 <= config.most_pixels


def test_smooth_labels_keep_neighbours_touching():
    labels = np.zeros((12, 12), np.int64)
    labels[2:10, 2:6], labels[2:10, 6:10] = 1, 2
    fine = smooth_labels(labels, 4)
    middle = fine[24]
    assert middle[4 * 3] == 1
    assert middle[4 * 8] == 2
    inner = middle[10:38]
    assert (inner > 0).all()


def test_the_cells_are_tiles_that_cover_the_floor(drawing, two_rooms):
    cell = two_rooms.grid.geometry.resolution
    covered = ((drawing.tiles.sizes + 0.02) ** 2).sum()
    free = two_rooms.grid.free.sum() * cell**2
    assert covered == pytest.approx(free, rel=0.1)
    assert len(drawing.tiles.colours) == len(drawing.tiles.sizes)


def test_other_labels_change_nothing_else(drawing):
    other = relabelled(drawing, {"west": "kitchen", "east": None})
    assert [node.label for node in other.nodes] == ["kitchen", None]
    assert other.walls is drawing.walls
    assert [node.colour for node in other.nodes] == [node.colour for node in drawing.nodes]


def test_a_map_that_nobody_has_driven_or_cut_is_drawn(two_rooms):
    empty = TopologicalMap((), (), ())
    none = np.zeros_like(two_rooms.regions)
    drawing = draw(replace(two_rooms, topology=empty, regions=none, trajectory=None))
    assert drawing.nodes == ()
    assert len(drawing.path) == 0
    assert not drawing.walls.cap.empty


def test_a_map_of_which_nothing_is_known_is_drawn():
    geometry = GridGeometry(0.05, (0.0, 0.0, 0.0), (4, 6))
    nothing = np.zeros(geometry.shape, np.int64)
    grid = OccupancyGrid(geometry, nothing.astype(np.uint8))
    drawing = draw(Model(grid, nothing, nothing, TopologicalMap((), (), ()), None, {}))
    assert drawing.outline.min(axis=0) == pytest.approx((0.0, 0.0))
    assert drawing.outline.max(axis=0) == pytest.approx((0.3, 0.2))


def test_a_drive_is_thinned_but_keeps_its_ends():
    poses = np.column_stack((np.arange(101) * 0.01, np.zeros(101), np.zeros(101)))
    kept = thinned(poses, 0.05)
    assert kept[0] == 0
    assert kept[-1] == 100
    assert len(kept) == pytest.approx(21, abs=2)
    assert path_segments(poses[:1], 0.1).shape == (0, 2, 3)
    assert path_colours(5).shape == (5, 2, 3)


def test_a_sphere_is_round_closed_and_faces_outwards():
    mesh = icosphere(2)
    points = mesh.vertices.astype(float)
    assert np.linalg.norm(points, axis=1) == pytest.approx(1.0)
    assert (len(points), len(mesh.faces)) == (162, 320)
    a, b, c = (points[mesh.faces[:, k]] for k in range(3))
    assert ((np.cross(b - a, c - a) * (a + b + c)).sum(axis=1) > 0).all()


def test_a_box_stands_on_the_floor_and_faces_outwards():
    mesh = unit_box()
    points = mesh.vertices.astype(float)
    assert points[:, 2].min() == 0.0
    a, b, c = (points[mesh.faces[:, k]] for k in range(3))
    middle = np.array([0.0, 0.0, 0.5])
    assert ((np.cross(b - a, c - a) * ((a + b + c) / 3 - middle)).sum(axis=1) > 0).all()


def test_a_circle_is_closed():
    ring = circle((1.0, 2.0, 3.0), 0.5)
    assert ring[0, 0] == pytest.approx(ring[-1, 1])
    assert np.linalg.norm(ring[:, 0] - (1.0, 2.0, 3.0), axis=1) == pytest.approx(0.5)


def test_values_that_are_no_numbers_never_reach_viser():
    server = PrivateViser()
    try:
        canvas = Canvas(server.scene)
        with pytest.raises(ValueError, match="finite"):
            canvas.lines("/x", np.full((1, 2, 3), np.nan), (0, 0, 0), 1.0)
        with pytest.raises(ValueError, match="finite"):
            canvas.label("/x", "text", (0.0, np.inf, 0.0))
        assert canvas.lines("/x", np.zeros((0, 2, 3)), (0, 0, 0), 1.0) is None
        assert server.scene.get_handle_by_name("/x") is None
    finally:
        server.stop()


def test_long_labels_are_cut_and_stay_on_one_line():
    assert shortened("kitchen\n of  grandma") == "kitchen of grandma"
    assert len(shortened("x" * 80)) == 32
    assert shortened("x" * 80).endswith("…")


def test_a_quarter_turn_as_a_quaternion():
    assert turned(np.pi / 2) == pytest.approx((0.7071, 0.0, 0.0, 0.7071), abs=1e-4)
