"""A simulated robot drives, a region is named, the robot is carried off and the bars tell."""

from __future__ import annotations

import time
from collections.abc import Iterator

import pytest

sync_api = pytest.importorskip("playwright.sync_api")
expect = sync_api.expect
pytestmark = pytest.mark.browser
COARSE = "?fixedDpr=0.5"
PATIENCE_MS = 180_000


def wait_for(product, robot: str, holds) -> dict:
    """The robot as soon as something holds."""
    end = time.monotonic() + PATIENCE_MS / 1000
    while not holds(found := product.api.get(f"/robots/{robot}").json()):
        assert time.monotonic() < end, found
        time.sleep(0.3)
    return found


@pytest.fixture
def robot(product) -> Iterator[dict]:
    """A robot that maps the paper's home; gone afterwards, whatever happens."""
    order = {"home": "paper", "seed": 3, "speed": 8, "odometry": "calibrated"}
    made = product.api.post("/robots", json=order)
    assert made.status_code == 201, made.text
    yield made.json()
    product.api.delete(f"/robots/{made.json()['id']}")


def test_a_robot_maps_is_named_a_room_and_finds_itself_again(product, robot, open_tab):
    robot, session = robot["id"], robot["session_id"]
    page = open_tab(f"{product.url}/{COARSE}#/live/{session}")
    rows = page.locator("tr[data-node]")
    expect(rows.first).to_be_visible(timeout=PATIENCE_MS)
    wait_for(product, robot, lambda r: r["distance_m"] > 12)

    node = rows.first.get_attribute("data-node")
    name = page.locator(f"tr[data-node='{node}'] input")
    name.fill("kitchen")
    name.press("Enter")
    wait_for(product, robot, lambda r: r["distance_m"] > 18)
    expect(name).to_have_value("kitchen")

    page.get_by_role("button", name="Localize in this map").click()
    wait_for(product, robot, lambda r: r["mode"] == "localization" and r["task"] != "waiting")
    expect(page.locator(".current-room strong")).to_be_visible(timeout=PATIENCE_MS)
    bars = page.locator(".live-belief .bar-figure")
    before = bars.all_inner_texts()

    answer = product.api.post(f"/robots/{robot}/commands", json={"type": "place"})
    assert answer.status_code == 200, answer.text
    end = time.monotonic() + PATIENCE_MS / 1000
    while bars.all_inner_texts() == before:
        assert time.monotonic() < end
        page.wait_for_timeout(300)
