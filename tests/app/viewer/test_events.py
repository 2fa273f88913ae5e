"""What a page and its 3D view tell each other, and that tabs do not disturb each other."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed

from app.viewer.hub import HubConfig
from core.segmentation.step_picture import StepPicture
from core.topology import Model

ONE, TWO = "tab-one-0001", "tab-two-0002"


def names(messages):
    return {message.get("name") for message in messages}


def test_a_page_is_told_first_what_is_drawn(server):
    with server.page("m1", ONE) as page:
        hello = page.wait_for("hello")
    assert hello["labels"] == {"west": None, "east": "study"}
    assert hello["layers"]["walls"] is True
    assert hello["layers"]["cells"] is False
    assert set(hello["colours"]) == {"west", "east"}
    assert hello["colours"]["west"] != hello["colours"]["east"]


def test_a_rename_reaches_every_tab_at_once(server, shows_label):
    with (
        server.page("m1", ONE) as page_one,
        server.page("m1", TWO) as page_two,
        server.view("m1", ONE) as view_one,
        server.view("m1", TWO) as view_two,
    ):
        for view in (view_one, view_two):
            view.wait_for(shows_label("Region 1"))
        server.rename("m1", "west", "kitchen")
        start = time.monotonic()
        for view in (view_one, view_two):
            view.wait_for(shows_label("kitchen"))
        assert time.monotonic() - start < 2.0
        for page in (page_one, page_two):
            assert page.wait_for("labels")["labels"]["west"] == "kitchen"


def test_a_name_taken_away_brings_the_stand_in_back(server, shows_label):
    with server.view("m1", ONE) as view:
        view.wait_for(shows_label("study"))
        server.rename("m1", "east", None)
        view.wait_for(shows_label("Region 2"))


def test_somebody_who_comes_later_sees_the_new_name(server, shows_label):
    with server.view("m1", ONE) as view:
        server.rename("m1", "west", "kitchen")
        view.wait_for(shows_label("kitchen"))
    with server.view("m1", TWO) as view:
        view.wait_for(shows_label("kitchen"))


def test_a_selection_is_marked_in_its_own_tab_only(server, shows_label):
    with (
        server.page("m1", ONE) as page,
        server.view("m1", ONE) as mine,
        server.view("m1", TWO) as other,
    ):
        for view in (mine, other):
            view.wait_for(shows_label("study"))
        page.send(type="select", node="east")
        mine.wait_for(lambda m: m.get("name") == "/selection/outline")
        assert "/selection/outline" not in names(other.drain())


def test_a_click_on_the_floor_selects_the_room_in_the_page(server):
    with server.page("m1", ONE) as page, server.view("m1", ONE) as view:
        assert page.wait_for("ready")["connected"]
        view.click(2.5, 2.6)
        assert page.wait_for("selected")["node"] == "east"
        view.click(50.0, 50.0)
        assert page.wait_for("selected")["node"] is None


def test_two_clicks_measure_a_distance(server):
    with server.page("m1", ONE) as page, server.view("m1", ONE) as view:
        assert page.wait_for("ready")["connected"]
        page.send(type="measure", on=True)
        assert page.wait_for("measured")["points"] == []
        view.click(0.0, 3.0)
        assert page.wait_for("measured")["distance_m"] is None
        view.click(0.3, 3.4)
        assert page.wait_for("measured")["distance_m"] == pytest.approx(0.5)
        view.wait_for(lambda m: (m.get("props") or {}).get("text") == "0.50 m")


def test_a_layer_is_hidden_in_its_own_tab_only(server, shows_label):
    def hides_walls(message):
        return message.get("name") == "/walls" and message.get("visible") is False

    with (
        server.page("m1", ONE) as page,
        server.view("m1", ONE) as mine,
        server.view("m1", TWO) as other,
    ):
        for view in (mine, other):
            view.wait_for(shows_label("study"))
        page.send(type="layers", layers={"walls": False, "no such layer": True})
        assert mine.wait_for(hides_walls)["owner"] != ""
        assert not any(map(hides_walls, other.drain()))


def test_a_view_that_reconnects_finds_what_its_tab_had(server, shows_label):
    with server.page("m1", ONE) as page:
        page.send(type="select", node="west")
        page.send(type="layers", layers={"walls": False})
        with server.view("m1", ONE) as view:
            view.wait_for(lambda m: m.get("name") == "/selection/outline")
        with server.view("m1", ONE) as view:
            view.wait_for(lambda m: m.get("name") == "/selection/outline")
            view.wait_for(lambda m: m.get("name") == "/walls" and m.get("visible") is False)


def test_the_camera_goes_to_the_top_view(server):
    with server.page("m1", ONE) as page, server.view("m1", ONE) as view:
        assert page.wait_for("ready")["connected"]
        view.drain()
        page.send(type="camera", view="top")
        assert page.wait_for("camera")["view"] == "top"
        moves = [m for m in view.drain() if m["type"] == "SetCameraPositionMessage"]
        x, y, z = moves[-1]["position"]
        assert (x, y) == (pytest.approx(1.1, abs=0.05), pytest.approx(3.1, abs=0.05))
        assert z > 20


def test_a_model_that_is_made_again_is_drawn_again(server, two_rooms: Model, shows_label):
    with server.page("m1", ONE) as page, server.view("m1", ONE) as view:
        view.wait_for(shows_label("study"))
        page.send(type="select", node="west")
        view.wait_for(lambda m: m.get("name") == "/selection/outline")
        nodes = two_rooms.topology.nodes[1:]
        smaller = type(two_rooms.topology)(nodes, (), ())
        server.models["m1"] = type(two_rooms)(
            two_rooms.grid, two_rooms.regions, two_rooms.rooms, smaller, None, {}
        )
        server.events.model_changed("m1")
        page.wait_for("model_changed")
        assert page_selected_nothing(view)


def page_selected_nothing(view) -> bool:
    return bool(
        view.wait_for(
            lambda m: m["type"] == "RemoveSceneNodeMessage" and m.get("name") == "/selection"
        )
    )


def test_pages_of_a_deleted_model_are_told_and_its_server_ends(server):
    with server.page("m1", ONE) as page, server.view("m1", ONE) as view:
        assert page.wait_for("ready")["connected"]
        del server.models["m1"]
        server.events.model_deleted("m1")
        page.wait_for("model_deleted")
        with pytest.raises(ConnectionClosed):
            view.drain(5)
    assert server.hub.opened("m1") is None


def test_a_view_that_nobody_looks_at_is_closed(serve_views, shows_label):
    server = serve_views(HubConfig(idle_after=0.2, sweep_every=0.05))
    with server.view("m1", ONE) as view:
        view.wait_for(shows_label("study"))
        time.sleep(0.5)
        assert server.hub.opened("m1") is not None
    end = time.monotonic() + 5
    while server.hub.opened("m1") is not None and time.monotonic() < end:
        time.sleep(0.05)
    assert server.hub.opened("m1") is None


@pytest.mark.parametrize("text", ["nonsense", '{"type": "select"}', '{"type": "explode"}', "[]"])
def test_a_message_that_means_nothing_ends_the_channel(server, text):
    with server.page("m1", ONE) as page:
        page.wait_for("hello")
        page.connection.send(text)
        with pytest.raises(ConnectionClosed) as closed:
            page.wait_for("never")
        assert closed.value.rcvd.code == 1003


def test_the_channel_of_an_unknown_model_closes_with_4404(server):
    with server.page("nothing", ONE) as page:
        with pytest.raises(ConnectionClosed) as closed:
            page.wait_for("hello")
        assert closed.value.rcvd.code == 4404


BELIEF = {
    "probabilities": {"west": 0.25, "east": 0.5, "gone": 0.05},
    "unknown": 0.2,
    "pose": [2.0, 3.0, 1.5707963],
    "template": [[1.0, 0.0], [0.0, 0.5]],
    "candidates": {"west": [0.1, 3.1, 0.0, 0.4], "gone": [0.0, 0.0, 0.0, 1.0]},
}


def test_a_step_that_is_played_is_seen_in_its_own_tab_only(server, shows_label):
    with (
        server.page("m1", ONE) as page,
        server.view("m1", ONE) as mine,
        server.view("m1", TWO) as other,
    ):
        for view in (mine, other):
            view.wait_for(lambda m: m.get("name") == "/lights/sun")
        page.send(type="playback", belief=BELIEF)
        for name in ("/robot/body/hull", "/robot/template", "/robot/candidates", "/bars/boxes"):
            mine.wait_for(lambda m, name=name: m.get("name") == name)
        mine.wait_for(shows_label("unknown"))
        page.send(type="playback", belief=BELIEF | {"unknown": 0.15, "template": [[0.0, 0.1]]})
        mine.wait_for(lambda m: "batched_positions" in (m.get("updates") or {}))
        mine.wait_for(lambda m: "batched_scales" in (m.get("updates") or {}))
        assert not {"/bars/boxes", "/robot/body"} & names(other.drain())


def test_a_view_that_reconnects_finds_the_step_until_it_is_ended(server):
    with server.page("m1", ONE) as page:
        page.send(type="playback", belief=BELIEF)
        with server.view("m1", ONE) as view:
            view.wait_for(lambda m: m.get("name") == "/bars/boxes")
            page.send(type="playback", belief=None)
            view.wait_for(
                lambda m: m["type"] == "RemoveSceneNodeMessage" and m["name"] == "/bars/boxes"
            )
        with server.view("m1", ONE) as view:
            view.wait_for(lambda m: m.get("name") == "/lights/sun")
            assert "/bars/boxes" not in names(view.drain())


@pytest.mark.parametrize("wrong", [{"unknown": 1.2}, {"pose": [0, 0]}, {"pose": [1e300, 0, 0]}])
def test_a_belief_that_cannot_be_drawn_closes_the_channel(server, wrong):
    with server.page("m1", ONE) as page:
        page.send(type="playback", belief=BELIEF | wrong)
        with pytest.raises(ConnectionClosed) as closed:
            page.wait_for("nothing")
        assert closed.value.rcvd.code == 1003


def test_probabilities_are_bars_in_one_tab(server):
    with server.view("m1", ONE) as mine, server.view("m1", TWO) as other:
        for view in (mine, other):
            view.wait_for(lambda m: m.get("name") == "/lights/sun")
        server.call(server.hub.set_probabilities, "m1", ONE, {"west": 0.25, "east": 0.75})
        mine.wait_for(lambda m: m.get("name") == "/bars/boxes")
        server.call(server.hub.set_probabilities, "m1", ONE, {"west": 0.5, "east": 0.5})
        mine.wait_for(lambda m: "batched_scales" in (m.get("updates") or {}))
        server.call(server.hub.set_robot, "m1", ONE, (0.5, 3.0, 1.0))
        mine.wait_for(lambda m: m.get("name") == "/robot/body/hull")
        assert "/bars/boxes" not in names(other.drain())


def with_one_moment(model: Model) -> Model:
    """The model as if a drive of one step had made it."""
    none = np.zeros_like(model.regions)
    hull = [[-1.0, 2.0], [1.0, 2.0], [1.0, 4.0]]
    history = (
        {
            "event": "step",
            "step": 0,
            "pose": [0.5, 3.0, 0.0],
            "picture": {"origin": list(model.grid.geometry.origin), "resolution": 0.05},
        },
        {"event": "extract", "step": 0, "accepted": True, "hull": hull, "cut": [hull[:2]]},
    )
    picture = StepPicture(model.grid.state, none, model.regions)
    return replace(model, history=history, timeline=(picture.png(),))


def test_a_moment_of_the_drive_takes_the_place_of_the_finished_model(server):
    server.models["grown"] = with_one_moment(server.models["m1"])
    with server.page("grown", ONE) as page, server.view("grown", ONE) as view:
        assert page.wait_for("ready")["connected"]
        page.send(type="moment", step=0, decision=0)
        for part in ("floor", "hulls/yes", "chosen/yes", "cut"):
            view.wait_for(lambda m, name=f"/moment/{part}": m.get("name") == name)
        page.send(type="moment", step=None)
        view.wait_for(lambda m: m.get("name") == "/moment" and "Remove" in m["type"])


def test_a_moment_that_is_not_there_changes_nothing(server):
    with server.page("m1", ONE) as page, server.view("m1", ONE) as view:
        assert page.wait_for("ready")["connected"]
        view.drain()
        page.send(type="moment", step=5)
        assert "/moment/floor" not in names(view.drain())
