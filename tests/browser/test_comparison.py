"""Two models of one drive stand side by side."""

from __future__ import annotations

import time

import pytest

sync_api = pytest.importorskip("playwright.sync_api")
expect = sync_api.expect
pytestmark = pytest.mark.browser
COARSE = "?fixedDpr=0.5"
MODEL_PATIENCE_S = 240


def test_two_models_of_one_drive_are_held_against_each_other(product, drive, open_tab):
    with drive.open("rb") as file:
        log = product.api.post("/logs", files={"file": ("drive.jsonl.gz", file)}).json()["id"]
    models = [quick_model(product, log, regions) for regions in (3, 5)]
    page = open_tab(f"{product.url}/{COARSE}#/models/{models[0]}")
    page.get_by_role("combobox", name="Compare with").select_option(models[1])
    page.wait_for_url(f"**/compare/{models[1]}")
    expect(page.locator("iframe.view3d")).to_have_count(2)
    expect(page.locator(".compare")).to_contain_text("Regions35")
    expect(page.locator(".pairs li")).to_have_count(5)
    expect(page.locator(".parameters")).to_contain_text("options.regions3 →\u00a05")
    page.get_by_role("link", name="Rooms", exact=True).click()
    expect(page.locator("iframe.view3d")).to_have_count(1)

    page.go_back()
    expect(page.locator("iframe.view3d")).to_have_count(2)
    product.api.delete(f"/models/{models[1]}")
    page.evaluate("dispatchEvent(new Event('focus'))")
    page.wait_for_url(f"**/models/{models[0]}")
    expect(page.locator(".toast")).to_contain_text("The model beside it is gone.")
    expect(page.locator("iframe.view3d")).to_have_count(1)


def quick_model(product, log: str, regions: int) -> str:
    """A coarse model of a log; its id."""
    options = {"mode": "offline", "regions": regions, "resolution": 0.1, "odometry": "raw"}
    body = options | {"mapping": "bayes", "log_id": log, "name": f"{regions} regions"}
    made = product.api.post("/models", json=body).json()
    end = time.monotonic() + MODEL_PATIENCE_S
    while (job := product.api.get(f"/jobs/{made['job_id']}").json())["status"] != "done":
        assert job["status"] in ("queued", "running"), job
        assert time.monotonic() < end, job
        time.sleep(0.5)
    return str(made["id"])
