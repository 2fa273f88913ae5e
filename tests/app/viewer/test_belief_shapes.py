"""How high bars are and where they stand."""

from __future__ import annotations

import numpy as np
import pytest

from app.viewer.belief_shapes import (
    BEST_BAR,
    BarPlan,
    arrow,
    evenly,
    plan_bars,
    unknown_spot,
    with_unknown,
)
from app.viewer.drawing import draw
from app.viewer.messages import Belief
from app.viewer.playback import in_world


@pytest.fixture
def drawing(two_rooms):
    return draw(two_rooms)


def test_a_bar_stands_below_its_node_as_high_as_its_probability(drawing):
    plan = plan_bars(drawing, {"east": 0.75, "west": 0.25}, None)
    assert plan.scales[:, 2] == pytest.approx([0.25 * 1.4, 0.75 * 1.4])
    for foot, node in zip(plan.feet, drawing.nodes, strict=True):
        assert foot[:2] == pytest.approx(node.centre[:2])
        assert foot[2] + BarPlan.FULL_HEIGHT < node.centre[2]


@pytest.mark.parametrize(("unknown", "best"), [(0.1, 1), (0.8, 2)])
def test_only_the_greatest_bar_is_red_be_it_a_node_or_unknown(drawing, unknown, best):
    plan = plan_bars(drawing, {"west": 0.05, "east": 0.15}, unknown)
    assert [colour == BEST_BAR for colour in plan.colours] == [i == best for i in range(3)]


def test_the_bar_of_unknown_stands_outside_the_home_but_in_the_picture(drawing):
    plan = plan_bars(drawing, {"west": 0.5}, 0.5)
    assert plan.feet[-1, :2] == pytest.approx(unknown_spot(drawing))
    assert plan.feet[-1, 0] > drawing.outline[:, 0].max() + 0.3
    assert with_unknown(drawing)[:, 0].max() > plan.feet[-1, 0] + plan.scales[-1, 0] / 2


def test_nodes_that_are_not_drawn_have_no_bar_and_none_gives_no_bars(drawing):
    assert len(plan_bars(drawing, {"west": 0.4, "gone": 0.6}, None).feet) == 1
    assert len(plan_bars(drawing, {}, None).feet) == 0


def test_a_bar_grows_from_one_step_to_the_next(drawing):
    low = plan_bars(drawing, {"west": 0.2, "east": 0.8}, 0.0)
    high = plan_bars(drawing, {"west": 0.6, "east": 0.4}, 0.0)
    heights = [high.on_the_way_from(low, share).scales[0, 2] for share in (0.0, 0.5, 1.0)]
    assert heights == pytest.approx([0.28, 0.56, 0.84])
    other = plan_bars(drawing, {"west": 0.6}, 0.0)
    assert other.on_the_way_from(low, 0.5) is other


def test_points_are_always_as_many(drawing):
    assert evenly(2, 4).tolist() == [0, 0, 1, 1]
    assert evenly(1000, 4).tolist() == [0, 333, 666, 999]


def test_the_arrow_points_along_x():
    vertices = arrow().vertices
    assert vertices[:, 0].max() == pytest.approx(0.55)
    assert abs(vertices[vertices[:, 0] > 0.5, 1]).max() == 0
    assert np.isfinite(vertices).all()


def test_the_local_map_is_laid_onto_the_map_at_the_pose():
    belief = Belief(
        probabilities={}, unknown=1, pose=(2, 3, np.pi / 2), template=((1, 0), (0, 0.5))
    )
    assert in_world(belief) == pytest.approx(np.array([(2, 4), (1.5, 3)]))
