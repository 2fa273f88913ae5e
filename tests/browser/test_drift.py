"""Saying something about the drift from the page: a closure is rejected, seen and undone."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from core.log_readers.native import write_native
from core.simulation import DriveConfig, simulate

sync_api = pytest.importorskip("playwright.sync_api")
expect = sync_api.expect
pytestmark = pytest.mark.browser
MODELLING_S = 300
"""Seconds; a few on an idle machine."""


@pytest.fixture(scope="module")
def bad_drive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A log of a short drive with bad odometry, whose places are seen twice."""
    path = tmp_path_factory.mktemp("bad") / "bad.jsonl.gz"
    config = DriveConfig(mapping_length=35.0)
    write_native(simulate("paper", seed=3, odometry="bad", config=config).slice(0, 1000), path)
    return path


def made_model(product, drive: Path) -> str:
    """A finished model of five regions, made over the API."""
    log = product.api.post("/logs", files={"file": (drive.name, drive.read_bytes())}).json()
    made = product.api.post(
        "/models", json={"log_id": log["id"], "mode": "offline", "regions": 5, "resolution": 0.1}
    ).json()
    wait_for_model(product, made["id"])
    return made["id"]


def wait_for_model(product, model: str) -> None:
    """Until nothing is being made of the model."""
    end = time.monotonic() + MODELLING_S
    while product.api.get(f"/models/{model}").json()["status"] in ("queued", "running"):
        assert time.monotonic() < end
        time.sleep(0.2)


def drift_with(product, model: str, rejected: list[str]) -> dict:
    """The drift of the model once a person has rejected just these closures."""
    end = time.monotonic() + MODELLING_S
    while (drift := product.api.get(f"/models/{model}/drift").json())["edits"][
        "rejected"
    ] != rejected:
        assert time.monotonic() < end
        time.sleep(0.2)
    return drift


def test_a_closure_is_rejected_seen_and_undone(product, bad_drive, open_tab):
    model = made_model(product, bad_drive)
    before = product.api.get(f"/models/{model}/drift").json()
    page = open_tab(f"{product.url}/?fixedDpr=0.5#/models/{model}")
    page.get_by_role("link", name="Drift").click()
    expect(page.get_by_text("What was found")).to_be_visible(timeout=60_000)
    first = page.locator(".closures li").first
    wrong = first.get_attribute("data-closure")

    first.get_by_role("button", name="Reject").click()
    after = drift_with(product, model, [wrong])
    assert after["trajectory"] != before["trajectory"]
    expect(page.locator(".drift-said li")).to_have_count(1, timeout=60_000)

    page.keyboard.press("Control+z")
    back = drift_with(product, model, [])
    assert back["trajectory"] == before["trajectory"]
    expect(page.locator(".drift-said li")).to_have_count(0, timeout=60_000)


def test_each_thing_that_was_said_has_a_row_that_takes_it_back(product, bad_drive, open_tab):
    model = made_model(product, bad_drive)
    drive = product.api.get(f"/models/{model}/drift").json()["trajectory"]
    t, x, y = drive[len(drive) // 2][:3]
    wrong = product.api.get(f"/models/{model}/drift").json()["closures"][0]["id"]
    edits = f"/models/{model}/drift/edits"
    product.api.post(edits, json={"op": "drag", "t": t, "x": x + 0.3, "y": y})
    wait_for_model(product, model)
    product.api.post(edits, json={"op": "reject", "closure": wrong})
    drift_with(product, model, [wrong])
    page = open_tab(f"{product.url}/?fixedDpr=0.5#/models/{model}")
    page.get_by_role("link", name="Drift").click()
    rows = page.locator(".drift-said li")
    expect(rows).to_have_count(2, timeout=60_000)

    rows.filter(has_text="belongs at").get_by_role("button", name="Remove").click()

    expect(rows).to_have_count(1, timeout=60_000)
    expect(rows).to_contain_text("are not the same place")
    assert product.api.get(f"/models/{model}/drift").json()["edits"]["dragged"] == []
