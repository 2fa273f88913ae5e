"""The whole product in a process of its own, and Debian's Chromium to look at it."""

from __future__ import annotations

import re
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import httpx2
import pytest

from core.log_readers.native import write_native
from core.simulation import simulate

sync_api = pytest.importorskip("playwright.sync_api")

CHROMIUM_FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
"""Software rendering: the 3D view needs WebGL, the machine no graphics card."""
WINDOW = {"width": 1000, "height": 600}
START_S, STOP_S = 60, 15
PATIENCE_MS = 120_000
"""Software rendering on a busy machine is slow."""
COMMAND = "import sys; from app.cli import main; sys.exit(main())"


@dataclass
class Product:
    """A running server; `url` ends without a slash."""

    url: str
    data: Path
    process: subprocess.Popen[str]

    @property
    def api(self) -> httpx2.Client:
        """A client of its API."""
        return httpx2.Client(base_url=f"{self.url}/api", timeout=60)

    def stop(self) -> None:
        """Ends it as Ctrl-C does."""
        self.process.send_signal(signal.SIGINT)
        self.process.wait(STOP_S)


def start_product(data: Path, port: int = 0) -> Product:
    """Starts `echorooms serve` and waits until it says where it is."""
    command = [sys.executable, "-c", COMMAND, "serve", "--port", str(port), "--data", str(data)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    watchdog = threading.Timer(START_S, process.kill)
    watchdog.start()
    assert process.stdout is not None
    for line in process.stdout:
        found = re.search(r"(http://\S+?)/?(\s|$)", line)
        if found:
            watchdog.cancel()
            threading.Thread(target=process.stdout.read, daemon=True).start()
            return Product(found[1], data, process)
    pytest.fail("the server did not start")


@pytest.fixture(scope="session")
def chromium(need: Callable[[str], None]) -> Iterator[sync_api.Browser]:
    """The browser."""
    path = shutil.which("chromium") or shutil.which("chromium-browser")
    if path is None:
        need("no Chromium: install Debian's package `chromium`")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=list(CHROMIUM_FLAGS))
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def product(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Product]:
    """A server that tests share; they leave what they make and rely on nothing that others made."""
    product = start_product(tmp_path_factory.mktemp("shared"))
    yield product
    product.stop()


@pytest.fixture
def fresh(tmp_path: Path) -> Iterator[Callable[[], Product]]:
    """Starts a server on an empty data folder, or again on the same port and data."""
    running: list[Product] = []

    def start() -> Product:
        port = 0
        if running:
            running[-1].stop()
            port = int(running[-1].url.rsplit(":", 1)[1])
        running.append(start_product(tmp_path / "data", port))
        return running[-1]

    yield start
    running[-1].stop()


@pytest.fixture(scope="session")
def drive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A log of a drive through the paper's home."""
    path = tmp_path_factory.mktemp("drive") / "home.jsonl.gz"
    write_native(simulate("paper", seed=5), path)
    return path


@pytest.fixture
def open_tab(chromium: sync_api.Browser) -> Iterator[Callable[[str], sync_api.Page]]:
    """Opens an address in a browser profile of its own; a script error fails the test."""
    contexts: list[sync_api.BrowserContext] = []
    errors: list[str] = []

    def open_(url: str, **options: object) -> sync_api.Page:
        context = chromium.new_context(**({"viewport": WINDOW} | options))
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(PATIENCE_MS)
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(url)
        return page

    yield open_
    for context in contexts:
        context.close()
    # viser probes for eval, which its page's content policy forbids; it copes without.
    assert [error for error in errors if "unsafe-eval" not in error] == []
