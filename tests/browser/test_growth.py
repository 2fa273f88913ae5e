"""A person replays why a room was cut."""

from __future__ import annotations

import time

import pytest

sync_api = pytest.importorskip("playwright.sync_api")
expect = sync_api.expect
pytestmark = pytest.mark.browser
COARSE = "?fixedDpr=0.5"
PATIENCE_MS = 120_000
MODEL_PATIENCE_S = 240
SHOWN = "(name) => Boolean(window.__viserSceneTree?.getState()[name])"
"""Whether the 3D view has a node of that name."""
HEIGHTS = """
() => {
  const floor = document.querySelector(".convexity").getBoundingClientRect().bottom;
  const limit = floor - document.querySelector(".convexity-limit").getBoundingClientRect().top;
  const bars = [...document.querySelectorAll(".convexity-bar")];
  const highest = Math.max(...bars.map((bar) => bar.firstChild.getBoundingClientRect().height));
  return [limit, highest];
}
"""
"""Pixels above the floor of the chart: of the line, of the highest bar."""


def grown_model(product, path) -> str:
    """A coarse model that grew along a drive; its id."""
    with path.open("rb") as file:
        log = product.api.post("/logs", files={"file": ("drive.jsonl.gz", file)}).json()
    options = {"mode": "autonomous", "resolution": 0.1, "odometry": "raw", "log_id": log["id"]}
    made = product.api.post("/models", json=options).json()
    end = time.monotonic() + MODEL_PATIENCE_S
    while (job := product.api.get(f"/jobs/{made['job_id']}").json())["status"] != "done":
        assert job["status"] in ("queued", "running"), job
        assert time.monotonic() < end, job
        time.sleep(0.5)
    return made["id"]


def wait_until(page, holds) -> None:
    """Waits for something in the 3D view, whose page may not evaluate strings by itself."""
    end = time.monotonic() + PATIENCE_MS / 1000
    while not holds():
        assert time.monotonic() < end
        page.wait_for_timeout(200)


def test_a_person_replays_how_a_model_grew(product, drive, open_tab):
    model = grown_model(product, drive)
    moments = product.api.get(f"/models/{model}/timeline").json()
    first = next(i for i, m in enumerate(moments) if any(d["accepted"] for d in m["decisions"]))
    page = open_tab(f"{product.url}/{COARSE}#/models/{model}")
    made = product.api.get(f"/models/{model}").json()
    expect(page.locator(".convexity-bar")).to_have_count(len(made["nodes"]))
    limit, highest = page.evaluate(HEIGHTS)
    most = made["provenance"]["segmentation"].get("most_hidden", 0.2)
    shown = max(node["convexity"] for node in made["nodes"])
    assert limit / highest == pytest.approx(most / shown, rel=0.1)

    page.get_by_role("link", name="How it grew along the drive").click()
    expect(page.locator(".player-place")).to_contain_text(f"Step {first + 1} of {len(moments)}")
    expect(page.locator(".step-state")).to_have_text("extracted")
    decisions = moments[first]["decisions"]
    expect(page.locator(".decision")).to_have_count(len(decisions))
    region = next(d["region"] for d in decisions if d["accepted"])
    page.get_by_role("button", name=f"became region {region}").click()
    frame = page.frame_locator("iframe.view3d").owner.element_handle().content_frame()
    wait_until(page, lambda: frame.evaluate(SHOWN, "/moment/chosen/yes"))

    page.keyboard.press("End")
    expect(page.locator(".player-place")).to_contain_text(f"Step {len(moments)} of")
    node = made["nodes"][0]["id"]
    with page.expect_response(f"**/models/{model}/timeline"):
        product.api.patch(f"/models/{model}/nodes/{node}", json={"label": "kitchen"})
    expect(page.locator(f"tr[data-node='{node}'] input")).to_have_value("kitchen")
    expect(page.locator(".player-place")).to_contain_text(f"Step {len(moments)} of")
    page.get_by_role("link", name="Rooms", exact=True).click()
    expect(page.locator("#player")).to_be_hidden()
    wait_until(page, lambda: not frame.evaluate(SHOWN, "/moment/floor"))
