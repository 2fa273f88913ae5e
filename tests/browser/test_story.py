"""The whole story in a real browser: from a log to a named room that is still there tomorrow."""

from __future__ import annotations

import contextlib
import json
import time

import pytest

from app.viewer.graph_shapes import GraphConfig

sync_api = pytest.importorskip("playwright.sync_api")
pytestmark = pytest.mark.browser
PATIENCE_S = 30.0
MOST_CLICKS = 6
COARSE = "?fixedDpr=0.5"
"""Half the pixels each way: the scene is rendered without a graphics card."""

PROJECT = """
(point) => {
  const camera = window.__viserMutable.camera;
  const [w, ...axis] = window.__viserSceneTree.getState()[""].wxyz;
  const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
  const first = cross(axis, point);
  const second = cross(axis, first);
  const turned = point.map((value, i) => value + 2 * (w * first[i] + second[i]));
  const four = [0, 1, 2, 3];
  const times = (m, v) => four.map((row) => four.reduce((sum, k) => sum + m[4 * k + row] * v[k], 0));
  camera.updateMatrixWorld();
  const eye = times(camera.matrixWorldInverse.elements, [...turned, 1]);
  const clip = times(camera.projectionMatrix.elements, eye);
  return [(clip[0] / clip[3] + 1) / 2 * innerWidth, (1 - clip[1] / clip[3]) / 2 * innerHeight];
}
"""
"""World point -> pixel of the 3D view; viser's scene is turned so that the world's z is up."""
PRESS_R = """() => {
    dispatchEvent(new KeyboardEvent("keydown", { key: "r", bubbles: true, cancelable: true }));
    return parent.document.activeElement.className;
}"""
"""In the view, the cursor is in the name before another key can come (busy machines lost a letter)."""
LABELS = """
() => Object.values(window.__viserSceneTree.getState())
  .map((node) => node?.message?.props?.text).filter(Boolean)
"""


def make_model(page, drive, regions: int) -> None:
    """Uploads the log and has it cut into regions; ends when the 3D view is there."""
    page.set_input_files("input[type=file]", str(drive))
    page.wait_for_selector(".report .verdict.good")
    page.get_by_text("A number of regions").click()
    page.fill("#regions", str(regions))
    page.get_by_role("button", name="Make the model").click()
    view_is_ready(page)


def view_is_ready(page) -> None:
    page.wait_for_selector(".dot[data-kind=good]")


def view_frame(page):
    return page.frame_locator("iframe.view3d").owner.element_handle().content_frame()


def select_in_3d(page, node: dict[str, object]) -> None:
    """Clicks the sphere of a node in the 3D view; again when the camera has moved meanwhile."""
    row = page.locator(f"tr.selected[data-node='{node['id']}']")
    for _ in range(MOST_CLICKS):
        at = view_frame(page).evaluate(PROJECT, [*node["position"], GraphConfig().height])
        box = page.locator("iframe.view3d").bounding_box()
        page.mouse.click(box["x"] + at[0], box["y"] + at[1])
        with contextlib.suppress(sync_api.TimeoutError):
            row.wait_for(timeout=1000 * PATIENCE_S / MOST_CLICKS)
            return
    pytest.fail("no click selected the node")


def labels_in_3d(page) -> list[str]:
    return view_frame(page).evaluate(LABELS)


def wait_for_label(page, text: str) -> None:
    end = time.monotonic() + PATIENCE_S
    while text not in labels_in_3d(page):
        assert time.monotonic() < end, f"{text!r} is not among {labels_in_3d(page)}"
        page.wait_for_timeout(50)


def test_from_a_log_to_a_room_whose_name_is_still_there(fresh, drive, open_tab):
    product = fresh()
    page = open_tab(f"{product.url}/{COARSE}")
    page.wait_for_selector("text=From sonar to named rooms")
    make_model(page, drive, regions=5)
    model_id = page.url.rsplit("/", 1)[1]
    nodes = product.api.get(f"/models/{model_id}").json()["nodes"]
    assert len(nodes) == 5
    assert page.locator("table.nodes tbody tr").count() == 5

    other = open_tab(page.url)
    view_is_ready(other)

    node = max(nodes, key=lambda node: node["area_m2"])
    select_in_3d(page, node)
    assert page.locator("tr.selected").count() == 1

    assert view_frame(page).evaluate(PRESS_R) == "node-name"
    page.keyboard.type("kitchen <b>")
    page.keyboard.press("Enter")
    for tab in (page, other):
        wait_for_label(tab, "kitchen <b>")
    row = other.locator(f"tr[data-node='{node['id']}'] input")
    sync_expect(lambda: row.input_value() == "kitchen <b>", other)
    assert other.locator("tr.selected").count() == 0

    page.reload()
    view_is_ready(page)
    assert page.locator(f"tr[data-node='{node['id']}'] input").input_value() == "kitchen <b>"
    wait_for_label(page, "kitchen <b>")

    product = fresh()
    view_is_ready(page)
    stored = product.api.get(f"/models/{model_id}").json()["nodes"]
    assert next(n["label"] for n in stored if n["id"] == node["id"]) == "kitchen <b>"
    for tab in (page, other):
        wait_for_label(tab, "kitchen <b>")


def test_the_view_obeys_the_page(product, drive, open_tab):
    page = open_tab(f"{product.url}/{COARSE}")
    make_model(page, drive, regions=4)
    page.locator("table.nodes tbody tr").nth(1).locator("td").first.click()
    page.wait_for_selector(".selected-name")

    page.keyboard.press("2")
    page.wait_for_selector("button[aria-pressed=true]:has-text('Top')")
    fov = "() => window.__viserMutable.camera.fov"
    sync_expect(lambda: view_frame(page).evaluate(fov) == pytest.approx(6, abs=0.1), page)

    page.keyboard.press("m")
    box = page.locator("iframe.view3d").bounding_box()
    for share, next_shown in ((0.4, "text=Now click the other end"), (0.6, ".strip strong")):
        page.mouse.click(box["x"] + share * box["width"], box["y"] + 0.5 * box["height"])
        page.wait_for_selector(next_shown)
    shown = page.locator(".strip strong").inner_text()
    assert float(shown.removesuffix(" m")) > 0.5
    wait_for_label(page, shown)
    page.keyboard.press("Escape")
    page.wait_for_selector(".strip", state="hidden")

    page.locator("#layer-walls").uncheck()
    walls = "() => window.__viserSceneTree.getState()['/walls'].visibility"
    sync_expect(lambda: view_frame(page).evaluate(walls) is False, page)

    page.keyboard.press("t")
    theme = "() => document.documentElement.dataset.theme"
    for frame in (page.main_frame, view_frame(page)):
        sync_expect(lambda frame=frame: frame.evaluate(theme) == "dark", page)

    with page.expect_download() as picture:
        page.keyboard.press("p")
    assert picture.value.suggested_filename.endswith(".png")
    assert picture.value.path().stat().st_size > 10_000


def test_files_can_be_dropped_and_errors_are_told(product, drive, open_tab):
    page = open_tab(product.url)
    page.wait_for_selector(".welcome")
    before = len(product.api.get("/logs").json())
    drop(page, "empty.jsonl", b"")
    page.wait_for_selector(".toast-error >> text=empty.jsonl")
    broken = b'{"format": "echorooms-log", "version": 1, "sonars": []}\n'
    drop(page, "broken.jsonl", broken)
    page.wait_for_selector(".toast-error >> text=broken.jsonl, line 1")
    assert len(product.api.get("/logs").json()) == before
    drop(page, drive.name, drive.read_bytes())
    page.wait_for_selector(".report .verdict")
    assert len(product.api.get("/logs").json()) == before + 1


def test_a_job_shows_how_far_it_is_and_can_be_cancelled(product, drive, open_tab):
    page = open_tab(product.url)
    page.set_input_files("input[type=file]", str(drive))
    page.get_by_text("A number of regions").click()
    page.get_by_role("button", name="Make the model").click()
    page.wait_for_selector(".job progress")
    page.get_by_role("button", name="Cancel").click()
    page.wait_for_selector("text=The model was cancelled")
    page.get_by_role("button", name="Try again from its log").click()
    page.wait_for_selector("form >> text=Make a model")
    assert page.locator("#regions").input_value() == "10"


def test_lists_are_searched_renamed_and_emptied(product, drive, open_tab):
    page = open_tab(product.url)
    page.set_input_files("input[type=file]", str(drive))
    page.wait_for_selector(".report")
    log_id = page.url.rsplit("/", 1)[1]
    item = page.locator(f"[data-item='log:{log_id}']")
    item.hover()
    item.locator("button[aria-label^=Rename]").click()
    page.locator("input.rename").fill("Tuesday's drive")
    page.keyboard.press("Enter")
    page.wait_for_selector(".report h2 >> text=Tuesday's drive")
    assert product.api.get(f"/logs/{log_id}").json()["name"] == "Tuesday's drive"

    page.keyboard.press("/")
    page.keyboard.type("wednesday")
    page.wait_for_selector("nav >> text=Nothing matches.")
    assert item.count() == 0
    page.keyboard.press("Control+A")
    page.keyboard.type("tues")
    page.wait_for_selector(f"[data-item='log:{log_id}']")

    item.hover()
    item.locator("button[aria-label^=Delete]").click()
    page.locator("dialog >> text=Cancel").click()
    assert product.api.get(f"/logs/{log_id}").status_code == 200
    item.hover()
    item.locator("button[aria-label^=Delete]").click()
    page.get_by_role("button", name="Delete", exact=True).click()
    page.wait_for_selector(".welcome")
    assert product.api.get(f"/logs/{log_id}").status_code == 404


def test_the_page_can_be_used_without_a_mouse(product, open_tab):
    page = open_tab(product.url)
    page.wait_for_selector(".welcome")
    page.keyboard.press("?")
    page.wait_for_selector("dialog >> text=Getting started")
    page.keyboard.press("Escape")
    page.wait_for_selector("dialog", state="detached")
    page.keyboard.press("Tab")
    assert page.evaluate("() => document.activeElement.className") == "skip-link"
    names = page.evaluate(
        "() => [...document.querySelectorAll('button, input:not([type=file]), a')]"
        ".filter((e) => e.checkVisibility())"
        ".filter((e) => !(e.ariaLabel || e.textContent.trim() || e.labels?.length)).length"
    )
    assert names == 0


def drop(page, name: str, content: bytes) -> None:
    """Drops a file on the page as a person would."""
    page.evaluate(
        """([name, bytes]) => {
          const data = new DataTransfer();
          data.items.add(new File([new Uint8Array(bytes)], name));
          for (const type of ["dragenter", "dragover", "drop"]) {
            const options = { dataTransfer: data, bubbles: true, cancelable: true };
            window.dispatchEvent(new DragEvent(type, options));
          }
        }""",
        [name, json.loads(json.dumps(list(content)))],
    )


def sync_expect(holds, page, seconds: float = PATIENCE_S) -> None:
    """Waits until something holds."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "it never came true"
        page.wait_for_timeout(50)
