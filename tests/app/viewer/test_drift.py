"""A drive before and after its correction in the 3D view."""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from app.viewer.drift_drawing import ODOMETRY_OCCUPIED, draw_drift
from app.viewer.floor_image import LIGHT
from core.mapping.drift_view import DriftView
from core.mapping.map_server import PIXEL_FREE, PIXEL_OCCUPIED, PIXEL_UNKNOWN
from core.topology import Model

TAB = "tab-drift-0001"


@pytest.fixture
def drifted(two_rooms: Model) -> Model:
    """The two rooms; a straight drive of 2 m whose odometry turned left by 1 m on the way."""
    x = np.linspace(0, 2, 11)
    rows = np.column_stack((np.arange(11.0), x, 0 * x + 3.0, 0 * x, x, 3.0 + x / 2, 0 * x))
    pixels = np.full((2, 3), PIXEL_UNKNOWN, np.uint8)
    pixels[0, 0], pixels[1, 0] = PIXEL_OCCUPIED, PIXEL_FREE
    png = io.BytesIO()
    Image.fromarray(pixels).save(png, "PNG")
    place = {"origin": [0.0, 2.0, 0.0], "resolution": 0.05, "shape": [2, 3]}
    report = {"edits": {}, "trajectory": rows.tolist(), "map": place, "odometry_map": place}
    found = [
        {"id": "c0_9000", "t_source": 0.0, "t_target": 9.0, "accepted": True},
        {"id": "c1000_8000", "t_source": 1.0, "t_target": 8.0, "accepted": False},
    ]
    return replace(
        two_rooms,
        provenance={"odometry": {"closures": found}},
        drift=DriftView(report, png.getvalue()),
    )


def test_a_model_of_a_map_has_no_drive_to_show(two_rooms):
    assert draw_drift(two_rooms) is None


def test_the_drive_lies_between_odometry_and_correction(drifted):
    drift = draw_drift(drifted)

    assert drift.between(0.0)[-1] == pytest.approx((2.0, 4.0))
    assert drift.between(0.5)[-1] == pytest.approx((2.0, 3.5))
    assert drift.between(1.0)[-1] == pytest.approx((2.0, 3.0))


def test_a_closure_joins_the_places_at_its_times(drifted):
    accepted, rejected = draw_drift(drifted).closures

    assert (accepted.source, accepted.target, accepted.accepted) == (0, 9, True)
    assert (rejected.source, rejected.target, rejected.accepted) == (1, 8, False)


def test_the_map_at_the_odometry_has_row_0_at_the_bottom_and_walls_of_its_own(drifted):
    picture = draw_drift(drifted).odometry_map.picture(LIGHT, 0.5, odometry=True)

    assert tuple(picture[1, 0]) == (*ODOMETRY_OCCUPIED, 128)
    assert tuple(picture[0, 0]) == (*LIGHT.free, 128)
    assert picture[0, 1, 3] == 0


def test_a_tab_shows_the_drift_and_then_the_model_again(server, drifted):
    server.models["m1"] = drifted
    with server.page("m1", TAB) as page, server.view("m1", TAB) as view:
        page.wait_for("ready")
        page.send(type="drift", on=True, share=0.5, closure="c0_9000", places=[3.0])
        for name in (
            "/maps/odometry", "/maps/corrected", "/odometry/line", "/corrected/line",
            "/closures/accepted", "/closures/chosen", "/drive/places",
        ):  # fmt: skip
            view.wait_for(lambda message, name=name: message.get("name") == name)
        page.send(type="drift", on=False)
        view.wait_for(
            lambda message: (
                message["type"] == "RemoveSceneNodeMessage"
                and message.get("name") == "/maps/odometry"
            )
        )


def test_a_click_tells_the_place_of_the_drive_that_is_nearest(server, drifted):
    server.models["m1"] = drifted
    with server.page("m1", TAB) as page, server.view("m1", TAB) as view:
        page.wait_for("ready")
        page.send(type="drift", on=True, share=0.0)
        view.wait_for(lambda message: message.get("name") == "/drive/line")
        view.click(2.0, 4.3)

        pointed = page.wait_for("pointed")

    assert pointed["t"] == 10.0
    assert pointed["away_m"] == pytest.approx(0.3)
