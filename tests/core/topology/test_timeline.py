from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from core.errors import ModelError
from core.mapping import GridGeometry
from core.pipeline.modeller import ModellingOptions, model_log
from core.segmentation.step_picture import StepPicture
from core.sensing import RobotLog
from core.topology import Model
from core.topology.model_folder import read_model, write_model
from core.topology.timeline import moments, picture_on_map

STEP = {"event": "step", "step": 0, "picture": {"origin": [0.1, 0.2, 0.0], "resolution": 0.1}}


@pytest.fixture(scope="module", params=["default", "paper"])
def model(request: pytest.FixtureRequest, square_room: RobotLog) -> Model:
    return model_log(square_room, ModellingOptions(method=request.param, odometry="raw"))


def test_a_drive_of_7_m_has_a_step_every_2_m_and_a_half_and_one_at_its_end(model: Model) -> None:
    found = moments(model.history)
    assert [moment["step"] for moment in found] == list(range(len(found)))
    assert [int(moment["distance_m"] / 2.5) for moment in found[:3]] == [1, 2, 2]
    assert found[0]["distance_m"] == pytest.approx(2.5, abs=0.2)
    assert found[-1]["decisions"][-1]["accepted"]
    assert len(model.timeline) == len(found)


def test_the_timeline_is_kept_in_the_model_folder(model: Model, tmp_path: Path) -> None:
    write_model(model, tmp_path / "home")
    back = read_model(tmp_path / "home")
    assert back.timeline == model.timeline
    assert moments(back.history) == moments(model.history)


def test_the_last_picture_shows_the_map_and_its_regions(model: Model) -> None:
    last = picture_on_map(model.timeline[-1], moments(model.history)[-1], model.grid.geometry)
    assert last.state.shape == model.regions.shape
    assert (last.state[model.regions > 0] == 1).all()
    shown = last.regions > 0
    np.testing.assert_array_equal(last.regions[shown], model.regions[shown])
    assert shown.any()


def test_edits_in_the_history_are_no_moments() -> None:
    history = (STEP, {"event": "extract", "step": 0, "region": 1}, {"event": "edit"})
    assert [len(moment["decisions"]) for moment in moments(history)] == [1]
    assert moments(({"event": "offline", "regions": 3},)) == []


def test_a_picture_lies_where_its_step_says() -> None:
    layer = np.ones((1, 1), np.int64)
    png = StepPicture(layer.astype(np.uint8), layer, layer).png()
    placed = picture_on_map(png, STEP, GridGeometry(0.1, (0.0, 0.0, 0.0), (4, 4)))
    assert np.argwhere(placed.state == 1).tolist() == [[2, 1]]


@pytest.mark.parametrize(
    "place", [None, {}, {"origin": [0.0], "resolution": 0.1}, {"origin": "ab", "resolution": 0.1}]
)
def test_a_step_without_a_place_is_refused(place: object) -> None:
    geometry = GridGeometry(0.1, (0.0, 0.0, 0.0), (4, 4))
    with pytest.raises(ModelError, match="where its picture lies"):
        picture_on_map(b"", {"picture": place}, geometry)


def test_a_picture_of_another_resolution_is_refused() -> None:
    with pytest.raises(ModelError, match="does not fit"):
        picture_on_map(b"", STEP, GridGeometry(0.05, (0.0, 0.0, 0.0), (4, 4)))
