"""Makes the README's pictures of the running product.

    python tests/browser/make_screenshot.py
    python tests/browser/make_screenshot.py --log corridor.zip --out static/docs/corridor.png

A drive through a furnished home is simulated, uploaded and modelled; the rooms get the names that the
home has; Chromium takes the picture. With `--log` that log is taken instead, and nothing is named.
"""

from __future__ import annotations

import argparse
import importlib.util
import io
import shutil
import sys
import tempfile
import time
from pathlib import Path

import httpx2
import numpy as np
from PIL import Image
from playwright.sync_api import Page, sync_playwright

from core.geometry import compose, inverse, transform_points
from core.log_readers.native import write_native
from core.sensing import RobotLog
from core.simulation import Home, build_home, simulate

ROOT = Path(__file__).resolve().parents[2]
TARGET = ROOT / "static/docs/screenshot.png"
WINDOW = {"width": 1300, "height": 780}
MOST_BYTES = 400_000
SELECTED = "living room"


def main() -> None:
    """Takes the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--home", default="random-17")
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--regions", type=int, default=9)
    parser.add_argument("--log", type=Path)
    parser.add_argument("--dark", action="store_true")
    parser.add_argument("--out", type=Path, default=TARGET)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        log, path = None, options.log
        if path is None:
            log = simulate(options.home, seed=options.seed)
            path = Path(folder) / "Simulated flat.jsonl.gz"
            write_native(log, path)
        product = _conftest().start_product(Path(folder) / "data")
        try:
            with httpx2.Client(base_url=f"{product.url}/api", timeout=120) as api:
                asked = {"name": "Simulated flat", "mode": "offline", "regions": options.regions}
                model = _make_model(api, path, asked if log else {})
                if log:
                    _name_rooms(api, model, build_home(options.home), log)
            picture = _photograph(f"{product.url}/#/models/{model}", options.dark)
        finally:
            product.stop()
    _save(picture, options.out)


def _make_model(api: httpx2.Client, log: Path, asked: dict[str, object]) -> str:
    with log.open("rb") as file:
        log_id = api.post("/logs", files={"file": file}).raise_for_status().json()["id"]
    made = api.post("/models", json={"log_id": log_id, **asked}).raise_for_status().json()
    while (job := api.get(f"/jobs/{made['job_id']}").json())["status"] in ("queued", "running"):
        time.sleep(0.5)
    if job["status"] != "done":
        sys.exit(f"the model could not be made: {job['error']}")
    return str(made["id"])


def _name_rooms(api: httpx2.Client, model: str, home: Home, log: RobotLog) -> None:
    """Gives every node the name of the room of the home that it lies in; doubles are told apart."""
    assert log.truth is not None
    home_from_map = compose(log.truth[0], inverse(log.odometry[0]))
    taken: dict[str, int] = {}
    for node in api.get(f"/models/{model}").json()["nodes"]:
        x, y = transform_points(home_from_map, np.array([node["position"]]))[0]
        room = next(
            (
                room.name
                for room in home.rooms
                if any(b.x0 <= x <= b.x1 and b.y0 <= y <= b.y1 for b in room.boxes)
            ),
            None,
        )
        if room is not None:
            taken[room] = taken.get(room, 0) + 1
            name = room if taken[room] == 1 else f"{room} {taken[room]}"
            api.patch(f"/models/{model}/nodes/{node['id']}", json={"label": name.capitalize()})


def _photograph(url: str, dark: bool) -> bytes:
    chromium = shutil.which("chromium")
    if chromium is None:
        sys.exit("no Chromium: install Debian's package `chromium`")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=chromium, args=list(_conftest().CHROMIUM_FLAGS)
        )
        page = browser.new_page(viewport=WINDOW, color_scheme="dark" if dark else "light")
        page.set_default_timeout(120_000)
        page.goto(url)
        page.wait_for_selector(".dot[data-kind=good]")
        _select(page, SELECTED)
        page.wait_for_timeout(3000)
        picture = page.screenshot()
        browser.close()
    return picture


def _select(page: Page, name: str) -> None:
    for row in page.locator("table.nodes tbody tr").all():
        if row.locator("input").input_value().lower() == name:
            row.locator(".swatch").click()
            return


def _save(picture: bytes, target: Path) -> None:
    Image.open(io.BytesIO(picture)).convert("RGB").save(target, optimize=True)
    size = target.stat().st_size
    sys.stdout.write(f"{target}: {size} bytes\n")
    if size > MOST_BYTES:
        sys.exit(f"larger than {MOST_BYTES} bytes")


def _conftest():  # type: ignore[no-untyped-def]
    """The module beside this one that starts the product."""
    spec = importlib.util.spec_from_file_location(
        "browser_conftest", Path(__file__).with_name("conftest.py")
    )
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["browser_conftest"] = module
    spec.loader.exec_module(module)
    return module


if __name__ == "__main__":
    main()
