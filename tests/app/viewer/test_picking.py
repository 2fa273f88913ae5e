"""What a click means."""

from __future__ import annotations

import numpy as np
import pytest

from app.viewer.drawing import draw
from app.viewer.picking import floor_point, node_at, picked_node, region_outline

DOWN = np.array([0.0, 0.0, -1.0])


@pytest.fixture(scope="module")
def drawing(two_rooms):
    return draw(two_rooms)


def test_a_ray_meets_the_floor():
    assert floor_point(np.array([1.0, 2.0, 4.0]), np.array([0.5, 0.0, -1.0])) == (3.0, 2.0)


def test_a_ray_upwards_or_level_meets_no_floor():
    origin = np.array([0.0, 0.0, 1.0])
    assert floor_point(origin, np.array([0.0, 0.0, 1.0])) is None
    assert floor_point(origin, np.array([1.0, 0.0, 0.0])) is None


def test_a_point_belongs_to_the_region_it_is_in(drawing):
    assert node_at(drawing, (0.5, 3.5)) == "west"
    assert node_at(drawing, (2.5, 3.5)) == "east"


def test_a_point_on_a_wall_belongs_to_the_room_beside_it(drawing):
    assert node_at(drawing, (-0.95, 3.0)) == "west"


def test_a_point_far_from_everything_belongs_to_nothing(drawing):
    assert node_at(drawing, (40.0, 40.0)) is None
    assert node_at(drawing, (-1.6, 3.0)) is None


def test_a_sphere_is_hit_before_the_floor_behind_it(drawing):
    west = drawing.nodes[0]
    origin = np.array(west.centre) + np.array([-3.0, 0.0, 3.0])
    through = np.array([1.0, 0.0, -1.0])
    assert floor_point(origin, through)[0] > 1.2
    assert picked_node(drawing, origin, through) == "west"


def test_the_nearer_of_two_spheres_is_hit(drawing):
    west, east = (np.array(node.centre) for node in drawing.nodes)
    origin = west - (east - west)
    assert picked_node(drawing, origin, east - west) == "west"


def test_a_click_beside_everything_picks_nothing(drawing):
    assert picked_node(drawing, np.array([90.0, 90.0, 5.0]), DOWN) is None


def test_a_region_is_outlined_just_inside_itself(drawing):
    outline = region_outline(drawing, 1, 0.05)
    points = outline.reshape(-1, 3)
    assert (points[:, 2] == 0.05).all()
    assert points[:, 0].min() == pytest.approx(-0.9, abs=0.1)
    assert points[:, 0].max() == pytest.approx(1.1, abs=0.1)
    assert points[:, 1].max() <= 4.1
    assert region_outline(drawing, 99, 0.05).shape == (0, 2, 3)
