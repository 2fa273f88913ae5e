"""The page: every figure is in it, and nothing has to be loaded."""

from __future__ import annotations

import re

import numpy as np
import pytest

from app.reproduction.extent import Extent
from app.reproduction.figures.layers import region_layers
from app.reproduction.figures.map_figures import path_figure
from app.reproduction.figures.step_figures import max_probability_figure, sampled_steps
from app.reproduction.localized_drive import LocalizedDrive
from app.reproduction.many_homes import HomeFigures
from app.reproduction.page import Section, Table, page_of
from app.reproduction.paper_home_models import PaperHomeModels, convexities
from app.reproduction.results import results_of
from app.reproduction.sections import sections_of
from core.topology import Model


@pytest.fixture(scope="module")
def page(
    extent: Extent,
    paper_home: PaperHomeModels,
    localized: LocalizedDrive,
    homes: tuple[HomeFigures, ...],
) -> str:
    drives = {"static": localized}
    results = results_of(extent, paper_home, drives, homes)
    return page_of("Title", "Note", sections_of(paper_home, drives, homes, results))


@pytest.mark.parametrize(
    "figure",
    ["12", "13", "14-paper", "15-paper", "16-paper", "17-paper", "18-paper", "19-paper",
     "20-paper", "21-paper", "accuracy", "reliability"],
)  # fmt: skip
def test_every_figure_is_drawn_once(page: str, figure: str) -> None:
    assert page.count(f'<div id="fig-{figure}"') == 1


def test_the_page_loads_nothing(page: str) -> None:
    assert not re.search(r"<(?:script|link|img|iframe)[^>]+(?:src|href)=", page)
    assert "default-src 'none'" in page


def test_plotly_is_in_the_page_once(page: str) -> None:
    assert page.count("* plotly.js v") == 1


def test_text_is_escaped() -> None:
    section = Section("s", "<b>", ("a & b",), (Table("t", ("h",), (("<i>",),)),))
    page = page_of("x", "n", (section,))
    assert "&lt;b&gt;" in page
    assert "a &amp; b" in page
    assert "&lt;i&gt;" in page


def test_rejected_steps_have_another_colour(localized: LocalizedDrive) -> None:
    updated, rejected = max_probability_figure(localized, "paper").data
    assert list(updated.x) == [1]
    assert list(rejected.x) == [2]
    assert updated.marker.color != rejected.marker.color


def test_a_step_stands_where_the_robot_was(model: Model, localized: LocalizedDrive) -> None:
    numbers = path_figure(model, localized, "paper").data[-1]
    assert list(numbers.text) == ["1", "2"]
    assert list(numbers.x) == pytest.approx([4.6 + 0.15 * 4, 4.6 + 0.15 * 8])


def test_maps_keep_their_proportions(model: Model, localized: LocalizedDrive) -> None:
    assert path_figure(model, localized, "paper").layout.yaxis.scaleanchor == "x"


def test_regions_of_a_map_have_their_own_colours(model: Model) -> None:
    layer = region_layers(model.grid, model.regions)[-1]
    assert sorted(np.unique(np.asarray(layer.z))) == [0, 1, 2]
    assert len({colour for _, colour in layer.colorscale}) == 3


def test_sampled_steps_hold_the_first_and_the_last(localized: LocalizedDrive) -> None:
    steps = localized.steps["paper"] * 5
    assert [id(s) for s in sampled_steps(steps, 3)] == [id(steps[i]) for i in (0, 4, 9)]
    assert sampled_steps((), 3) == ()


def test_two_rectangular_rooms_are_convex(model: Model) -> None:
    for measures in convexities(model):
        assert measures.as_printed < 0.05
        assert measures.hidden_pairs < 0.05
