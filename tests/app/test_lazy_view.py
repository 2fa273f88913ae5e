"""The 3D view beside the API."""

from __future__ import annotations

import subprocess
import sys

from fastapi.testclient import TestClient

from app.main import create_app
from app.settings import Settings


def test_the_view_of_a_model_is_served_and_that_of_nothing_is_404(
    shared_client: TestClient, shared_model: str
) -> None:
    page = shared_client.get(f"/view/{shared_model}/")
    assert page.status_code == 200
    assert page.headers["content-type"].startswith("text/html")
    missing = shared_client.get("/view/0123456789abcdef/")
    assert missing.status_code == 404
    assert missing.headers["content-type"] == "application/problem+json"


def test_the_view_still_opens_after_it_was_named_and_is_gone_with_its_model(
    client: TestClient, make_model: object
) -> None:
    model_id = make_model(client)  # type: ignore[operator]
    node = client.get(f"/api/models/{model_id}").json()["nodes"][0]["id"]
    assert client.get(f"/view/{model_id}/").status_code == 200
    client.patch(f"/api/models/{model_id}/nodes/{node}", json={"label": "kitchen"})
    assert client.get(f"/view/{model_id}/").status_code == 200
    client.delete(f"/api/models/{model_id}")
    assert client.get(f"/view/{model_id}/").status_code == 404


def test_a_start_loads_neither_the_viewer_nor_the_heavy_science() -> None:
    program = (
        "import sys; from app.main import create_app; from app.settings import Settings; "
        "create_app(Settings()); heavy = ('viser', 'scipy', 'skimage', 'numba'); "
        "print([module for module in heavy if module in sys.modules])"
    )
    found = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert found.stdout.strip() == "[]"


def test_making_the_app_touches_nothing(tmp_path: object) -> None:
    create_app(Settings(data=tmp_path / "data"))  # type: ignore[operator]
    assert list(tmp_path.iterdir()) == []  # type: ignore[attr-defined]
