"""The 3D view of a live session: it grows in place, tab by tab, and outlives the session."""

from __future__ import annotations

import contextlib
import json
import math
from collections.abc import Callable
from typing import Any

import pytest
from websockets.sync.client import connect

from app.main import create_app
from app.settings import Settings

ONE, TWO = "live-tab-0001", "live-tab-0002"
SONARS = [
    {"x": 0, "y": 0, "heading": h, "beam_width": 0.5, "min_range": 0.1, "max_range": 4}
    for h in (0.0, 1.5, -1.5)
]
HEADER = {
    "format": "echorooms-log",
    "version": 1,
    "name": "robot",
    "robot": {"radius": 0.2},
    "sonars": SONARS,
}


def scan(i: int) -> dict[str, Any]:
    """Scan i of a robot that drives 0.1 m along x each time, with one echo."""
    return {"t": float(i), "odom": [3.0 + 0.1 * i, 5.0, 0.0], "ranges": [1.0, None, None]}


@pytest.fixture
def served(serve_app: Callable[..., Any], tmp_path) -> Any:
    """The whole product, in this process."""
    return serve_app(create_app(Settings(data=tmp_path / "data", warm_workers=0)))


@pytest.fixture
def session(served) -> str:
    """A live session."""
    answer = served.http.post("/api/live", json={"header": HEADER})
    return answer.json()["id"]


def send(served, session: str, *scans: dict[str, Any]) -> None:
    answer = served.http.post(f"/api/live/{session}/scans", json=list(scans))
    assert answer.status_code == 200, answer.text


def has_name(name: str) -> Callable[[dict[str, Any]], bool]:
    return lambda message: message.get("name") == name


def test_a_session_without_a_model_is_shown_around_its_robot(served, session):
    send(served, session, *[scan(i) for i in range(4)])
    with served.view(session, ONE) as view:
        way = view.wait_for(has_name("/robot/way/0"))
        assert way["type"] == "LineSegmentsMessage"
        view.wait_for(has_name("/beams/fans"))
        view.wait_for(has_name("/robot/body/hull"))


def test_what_moves_changes_in_place(served, session):
    send(served, session, *[scan(i) for i in range(4)])
    with served.view(session, ONE) as view:
        view.wait_for(has_name("/beams/dots"))
        view.drain()
        send(served, session, scan(4))
        news = view.drain()
    moved = [m for m in news if str(m.get("name")).startswith(("/beams", "/robot"))]
    assert {m["name"] for m in moved} >= {"/beams/fans", "/beams/arcs", "/robot/way/0"}
    made = [m["name"] for m in moved if "Update" not in m["type"] and "Set" not in m["type"]]
    assert made == []


def test_a_paused_tab_gets_nothing_while_the_other_goes_on(served, session):
    send(served, session, *[scan(i) for i in range(4)])
    with (
        served.page(session, ONE) as page,
        served.view(session, ONE) as paused,
        served.view(session, TWO) as drawn,
    ):
        for view in (paused, drawn):
            view.wait_for(has_name("/beams/dots"))
        page.send(type="live", follow=False, paused=True, at=None)
        paused.drain()
        drawn.drain()
        send(served, session, scan(4))
        assert any(m.get("name") == "/beams/fans" for m in drawn.drain())
        assert not any(m.get("name") == "/beams/fans" for m in paused.drain())


def test_a_page_hears_from_when_it_can_look_back_and_what_place_was_clicked(served, session):
    send(served, session, *[scan(i) for i in range(4)])
    with served.view(session, ONE) as view, served.page(session, ONE) as page:
        assert page.wait_for("track") == {"type": "track", "first_t": 0.0, "last_t": 3.0}
        page.wait_for("ready")
        page.send(type="pick", on=True)
        page.send(type="live", follow=False, paused=False, at=1.0)
        view.drain()
        view.click(3.5, 4.5)
        picked = page.wait_for("picked")
    assert (picked["x"], picked["y"]) == pytest.approx((3.5, 4.5))


def test_a_camera_that_follows_goes_with_the_robot(served, session):
    send(served, session, scan(0))
    with served.view(session, ONE) as view, served.page(session, ONE) as page:
        page.wait_for("ready")
        page.send(type="live", follow=True, paused=False, at=None)
        view.drain()
        send(served, session, scan(30))
        looks = [m for m in view.drain() if m["type"] == "SetCameraLookAtMessage"]
    assert math.dist(looks[-1]["look_at"][:2], (6.0, 5.0)) < 1e-6


def test_a_session_that_is_not_there_has_no_view(served):
    assert served.http.get("/view/none/").status_code == 404
    with (
        pytest.raises(Exception, match="no such model"),
        contextlib.closing(connect(served.url("/view/none/events?tab=" + ONE))) as socket,
    ):
        json.loads(socket.recv(5))
