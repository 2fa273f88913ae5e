"""What a tab's picture shows follows from what its page says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.segmentation.step_picture import StepPicture

ONE = "tab-one-0001"


@pytest.fixture
def grown(server):
    """The server with one more model, as if a drive of one step had made it."""
    model = server.models["m1"]
    place = {"origin": list(model.grid.geometry.origin), "resolution": 0.05}
    step = {"event": "step", "step": 0, "pose": [0.5, 3.0, 0.0], "picture": place}
    picture = StepPicture(model.grid.state, np.zeros_like(model.regions), model.regions)
    server.models["grown"] = replace(model, history=(step,), timeline=(picture.png(),))
    return server


def is_camera(message) -> bool:
    return message["type"] == "SetCameraPositionMessage"


def marks(message) -> bool:
    return message.get("name") == "/selection/outline"


def unmarks(message) -> bool:
    return message.get("name") == "/selection" and "Remove" in message["type"]


def test_a_region_selected_now_is_not_marked_in_the_past_of_the_model(grown):
    with grown.page("grown", ONE) as page, grown.view("grown", ONE) as view:
        assert page.wait_for("ready")["connected"]
        page.send(type="select", node="east")
        view.wait_for(marks)
        page.send(type="moment", step=0, decision=None)
        view.wait_for(unmarks)
        before = len(view.seen)
        page.send(type="moment", step=None)
        view.wait_for(lambda m: marks(m) and any(m is new for new in view.seen[before:]))


def test_the_camera_fits_the_picture_that_the_page_sees(server):
    with server.page("m1", ONE) as page, server.view("m1", ONE) as view:
        first = view.wait_for(is_camera)
        page.send(type="viewport", width=200, height=600)

        def is_farther(message) -> bool:
            return is_camera(message) and lift(message) > 1.5 * lift(first)

        view.wait_for(is_farther)


def test_a_browser_that_takes_its_first_view_after_it_was_sent_elsewhere_is_sent_again(server):
    with server.view("m1", ONE) as view:
        first = view.wait_for(is_camera)["position"]
        look = view.wait_for(lambda m: m["type"] == "SetCameraLookAtMessage")["look_at"]
        view.drain()
        sent = [m["position"] for m in view.seen if is_camera(m)][-1]
        assert sent != pytest.approx(first)
        view.send_camera(tuple(first), tuple(look))
        again = [m["position"] for m in view.drain(1.0) if is_camera(m)]
        assert again[-1] == pytest.approx(sent)
        view.send_camera((3.0, 3.0, 3.0))
        assert not [m for m in view.drain(1.0) if is_camera(m)]


def test_a_click_on_a_node_is_one_click(server):
    with server.view("m1", ONE) as view:
        view.wait_for(lambda m: m.get("name") == "/graph/nodes")
        view.drain()
        listens = [m for m in view.seen if m["type"] == "SetSceneNodeClickBindingsMessage"]
        assert not listens, "the scene tells of every click already"


def test_a_long_name_is_cut_in_the_picture(server, shows_label):
    with server.view("m1", ONE) as view:
        server.rename("m1", "west", "the room with the piano and the old sofa")
        view.wait_for(shows_label("the room with the piano and t…"))


def lift(message) -> float:
    return float(np.linalg.norm(message["position"]))
