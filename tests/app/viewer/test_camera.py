"""Standard views show all of a home."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.viewer.camera import CameraConfig, blend, farthest, fit_3d, fit_top
from app.viewer.label_layout import project

OUTLINE = np.array([(-3.0, 2.0), (9.0, 2.0), (9.0, 10.0), (-3.0, 10.0)])


def corners(height: float) -> np.ndarray:
    return np.array([(x, y, z) for x, y in OUTLINE for z in (0.0, height)])


@pytest.mark.parametrize("fit", [fit_3d, fit_top])
@pytest.mark.parametrize("aspect", [0.5, 1.0, 1.6, 3.0])
def test_everything_is_in_the_picture_and_fills_it(fit, aspect):
    points = corners(CameraConfig().headroom if fit is fit_3d else 0.0)
    flat = project(fit(OUTLINE, aspect), points)
    reach = np.abs(flat[:, :2]).max(axis=0) / (0.5 * aspect, 0.5)
    assert reach.max() <= CameraConfig().fill + 0.01
    assert reach.max() >= CameraConfig().fill - 0.05
    assert (flat[:, 2] > 0).all()


@pytest.mark.parametrize("fit", [fit_3d, fit_top])
def test_x_runs_to_the_right_and_y_up(fit):
    flat = project(fit(OUTLINE, 1.4), np.array([(0.0, 5.0, 0.0), (1.0, 5.0, 0.0), (0.0, 6.0, 0.0)]))
    assert flat[1, 0] > flat[0, 0]
    assert flat[2, 1] > flat[0, 1]


def test_the_top_view_hardly_shows_the_walls_sides():
    flat = project(fit_top(OUTLINE, 1.4), np.array([(-3.0, 2.0, 0.0), (-3.0, 2.0, 1.2)]))
    assert np.abs(flat[0, :2] - flat[1, :2]).max() < 0.01


@given(st.floats(0.0, 1.0))
def test_the_way_between_two_views_keeps_the_home_in_sight(share):
    a, b = fit_3d(OUTLINE, 1.4), fit_top(OUTLINE, 1.4)
    flat = project(blend(a, b, share), corners(0.0))
    assert np.isfinite(flat).all()
    assert (flat[:, 2] > 0).all()
    assert np.abs(flat[:, :2]).max() < 1.0


def test_the_way_begins_and_ends_at_the_views():
    a, b = fit_3d(OUTLINE, 1.4), fit_top(OUTLINE, 1.4)
    for share, view in ((0.0, a), (1.0, b)):
        on_way = blend(a, b, share)
        assert on_way.position == pytest.approx(view.position, rel=1e-6)
        assert on_way.fov == pytest.approx(view.fov)


def test_the_far_plane_is_behind_the_home():
    view = fit_top(OUTLINE, 1.4)
    assert farthest(view, OUTLINE) > 2 * view.position[2]


def test_a_single_point_can_be_looked_at():
    assert np.isfinite(fit_3d(np.array([(1.0, 1.0)]), 1.0).position).all()
