"""Merging two regions from the table and taking it back with the keyboard, in two tabs."""

from __future__ import annotations

import time

import pytest

pytestmark = pytest.mark.browser
MODELLING_S = 300
"""Seconds; a few on an idle machine."""


def made_model(product, drive) -> str:
    """A finished model of five regions, made over the API."""
    log = product.api.post("/logs", files={"file": (drive.name, drive.read_bytes())}).json()
    body = {"log_id": log["id"], "mode": "offline", "regions": 5}
    made = product.api.post("/models", json=body).json()
    end = time.monotonic() + MODELLING_S
    while product.api.get(f"/models/{made['id']}").json()["status"] in ("queued", "running"):
        assert time.monotonic() < end
        time.sleep(0.2)
    return made["id"]


def wait_for_rows(page, count: int) -> None:
    page.wait_for_function(
        "count => document.querySelectorAll('table.nodes tbody tr').length === count", arg=count
    )


def test_a_merge_is_seen_in_every_tab_and_undone_with_the_keyboard(product, drive, open_tab):
    model_id = made_model(product, drive)
    before = product.api.get(f"/models/{model_id}").json()
    page, other = (open_tab(f"{product.url}/#/models/{model_id}") for _ in range(2))
    for tab in (page, other):
        tab.wait_for_selector(".dot[data-kind=good]")
    edge = before["edges"][0]
    page.locator(f'tr[data-node="{edge["source"]}"] .swatch').click()
    page.locator(f'tr[data-node="{edge["target"]}"] .swatch').click(modifiers=["Control"])
    page.get_by_role("button", name="Merge 2 regions").click()
    page.locator(".toast", has_text="Merged").get_by_role("button", name="Undo").wait_for()
    for tab in (page, other):
        wait_for_rows(tab, 4)
    page.keyboard.press("Control+z")
    for tab in (page, other):
        wait_for_rows(tab, 5)
    after = product.api.get(f"/models/{model_id}").json()
    assert after["nodes"] == before["nodes"]
    assert after["edges"] == before["edges"]
    page.keyboard.press("Control+Shift+z")
    wait_for_rows(other, 4)
