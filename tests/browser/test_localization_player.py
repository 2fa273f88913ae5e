"""A localization is run from the page and stepped through."""

from __future__ import annotations

import re
import time

import pytest

from core.log_readers.native import write_native
from core.simulation import simulate

sync_api = pytest.importorskip("playwright.sync_api")
expect = sync_api.expect
pytestmark = pytest.mark.browser
COARSE = "?fixedDpr=0.5"
PATIENCE_MS = 120_000
MODEL_PATIENCE_S = 240
BAR_HEIGHTS = """
() => {
  const scales = window.__viserSceneTree.getState()["/bars/boxes"]?.message?.props?.batched_scales;
  if (!scales) return null;
  const { buffer, byteOffset, byteLength } = scales;
  const view = new Float32Array(buffer.slice(byteOffset, byteOffset + byteLength));
  return [...view].filter((_, index) => index % 3 === 2);
}
"""
"""Heights of the bars in the 3D view, metres."""


def upload(page, path) -> str:
    """Uploads a log; its id."""
    page.set_input_files("input[type=file]", str(path))
    page.wait_for_selector(".report")
    return page.url.rsplit("/", 1)[1]


def quick_model(product, log_id: str) -> str:
    """A coarse model of a log, whose map need not be a good one; its id."""
    options = {"mode": "offline", "regions": 4, "resolution": 0.1, "mapping": "bayes"}
    answer = product.api.post("/models", json=options | {"log_id": log_id, "odometry": "raw"})
    assert answer.status_code == 202, answer.text
    end = time.monotonic() + MODEL_PATIENCE_S
    while (job := product.api.get(f"/jobs/{answer.json()['job_id']}").json())["status"] != "done":
        assert job["status"] in ("queued", "running"), job
        assert time.monotonic() < end, job
        time.sleep(0.5)
    return answer.json()["id"]


def highest(values: list[float] | None) -> tuple[int, int]:
    """How many values there are, and which one is the greatest."""
    return (0, -1) if not values else (len(values), values.index(max(values)))


def figures(page) -> list[float]:
    """What the side panel says of every region and of `unknown`, in percent."""
    return [float(text.split()[0]) for text in page.locator(".bar-figure").all_inner_texts()]


def test_a_localization_is_run_from_the_page_and_played_step_by_step(
    product, drive, tmp_path, open_tab
):
    page = open_tab(f"{product.url}/{COARSE}")
    other = tmp_path / "other.jsonl.gz"
    write_native(simulate("paper", seed=6, tour="localization"), other)
    other_id = upload(page, other)
    model_id = quick_model(product, upload(page, drive))
    page.evaluate(f"location.hash = '#/models/{model_id}'")
    page.wait_for_selector(".dot[data-kind=good]")

    page.select_option("#localize-log", other_id)
    page.get_by_role("button", name="Localize").click()
    expect(page.locator("#player")).to_be_visible(timeout=PATIENCE_MS)
    page.keyboard.press(" ")
    page.get_by_role("button", name="Play").wait_for()
    address = page.url
    assert re.search(rf"#/models/{model_id}/localizations/[\w-]+$", address)
    localization_id = address.rsplit("/", 1)[1]
    steps = product.api.get(f"/localizations/{localization_id}/steps").json()
    assert len(steps) >= 3

    page.keyboard.press("Home")
    expect(page.locator(".player-place")).to_contain_text(f"Step 1 of {len(steps)}")
    page.keyboard.press("ArrowRight")
    expect(page.locator(".player-place")).to_contain_text("Step 2 of")
    nodes = [node["id"] for node in product.api.get(f"/models/{model_id}").json()["nodes"]]
    told = [100 * steps[1]["probabilities"][node] for node in nodes] + [100 * steps[1]["unknown"]]
    assert figures(page) == pytest.approx(told, abs=0.06)
    expect(page.locator(".step-state")).to_have_text(
        "updated" if steps[1]["updated"] else "rejected"
    )

    frame = page.frame_locator("iframe.view3d").owner.element_handle().content_frame()
    end = time.monotonic() + PATIENCE_MS / 1000
    while highest(frame.evaluate(BAR_HEIGHTS)) != (len(told), highest(told)[1]):
        assert time.monotonic() < end, frame.evaluate(BAR_HEIGHTS)
        page.wait_for_timeout(100)

    product.api.patch(f"/models/{model_id}/nodes/{nodes[0]}", json={"label": "kitchen"})
    expect(page.locator(".bars li").first).to_contain_text("kitchen", timeout=PATIENCE_MS)

    page.keyboard.press("End")
    expect(page.locator(".player-place")).to_contain_text(f"Step {len(steps)} of")
    expect(page.get_by_role("button", name="One step on")).to_be_disabled()
    again = open_tab(address)
    expect(again.locator(".player-place")).to_contain_text("Step 1 of", timeout=PATIENCE_MS)

    page.get_by_role("link", name="Rooms", exact=True).click()
    expect(page.locator("#player")).to_be_hidden()
    item = page.locator(f"[data-item='localization:{localization_id}']")
    item.hover()
    item.get_by_role("button", name=re.compile("Delete")).click()
    page.get_by_role("button", name="Delete", exact=True).click()
    expect(item).to_have_count(0)
    assert product.api.get(f"/localizations/{localization_id}").status_code == 404
