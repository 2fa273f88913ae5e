"""One shape for every error."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from app.errors import install_error_handlers
from core.errors import LogError, MapError, TooLargeError

MISSING = "0123456789abcdef"


def assert_problem(response: Any, status: int) -> str:
    """Checks the shape of a problem document and returns its line."""
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    problem = response.json()
    assert problem["status"] == status
    assert problem["title"]
    assert problem["detail"]
    assert "\n" not in problem["detail"]
    return str(problem["detail"])


@pytest.mark.parametrize(
    ("method", "path"),
    [
        ("GET", "/api/nothing"),
        ("POST", "/api/nothing/at/all"),
        ("GET", f"/api/logs/{MISSING}"),
        ("DELETE", f"/api/logs/{MISSING}"),
        ("GET", f"/api/models/{MISSING}"),
        ("DELETE", f"/api/models/{MISSING}"),
        ("GET", f"/api/models/{MISSING}/grid.png"),
        ("GET", f"/api/jobs/{MISSING}"),
        ("DELETE", f"/api/jobs/{MISSING}"),
        ("GET", f"/api/jobs/{MISSING}/events"),
        ("GET", "/api/logs/..%2f..%2fetc%2fpasswd"),
        ("GET", "/api/models/%2e%2e"),
        ("GET", "/no-such-page.html"),
    ],
)
def test_what_is_not_there_is_404(shared_client: TestClient, method: str, path: str) -> None:
    assert_problem(shared_client.request(method, path), 404)


@pytest.mark.parametrize(
    ("method", "path"),
    [("PUT", "/api/health"), ("POST", f"/api/jobs/{MISSING}"), ("PATCH", "/api/logs")],
)
def test_a_wrong_method_is_405(shared_client: TestClient, method: str, path: str) -> None:
    assert_problem(shared_client.request(method, path), 405)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ({}, "log_id"),
        ({"log_id": "x", "regions": 0}, "regions"),
        ({"log_id": "x", "regions": 10_000}, "regions"),
        ({"log_id": "x", "regions": "ten"}, "regions"),
        ({"log_id": "x", "mode": "psychic"}, "mode"),
        ({"log_id": "x", "mode": "autonomous", "regions": 4}, "offline"),
        ({"log_id": "x", "mode": "offline", "method": "paper"}, "number of regions"),
        ({"log_id": "x", "colour": "red"}, "colour"),
        ({"log_id": "x", "name": "a\x00b"}, "name"),
        ({"log_id": "x", "resolution": "NaN"}, "resolution"),
        ([1, 2, 3], "dictionary"),
    ],
)
def test_a_wrong_body_is_422_and_names_the_field(
    shared_client: TestClient, body: Any, words: str
) -> None:
    assert words in assert_problem(shared_client.post("/api/models", json=body), 422)


def test_a_body_that_is_no_json_is_422(shared_client: TestClient) -> None:
    response = shared_client.post(
        "/api/models", content=b"{not json", headers={"content-type": "application/json"}
    )
    assert_problem(response, 422)


def test_an_unknown_sort_field_is_422(shared_client: TestClient) -> None:
    assert "sort" in assert_problem(shared_client.get("/api/logs?sort=colour"), 422)


@pytest.fixture
def failing() -> Callable[[Exception], TestClient]:
    """A client of an app whose only route raises."""

    def make(error: Exception) -> TestClient:
        app = FastAPI()
        install_error_handlers(app)

        @app.get("/")
        def fail() -> None:
            raise error

        return TestClient(app, raise_server_exceptions=False)

    return make


def test_a_log_error_carries_its_line(failing: Callable[[Exception], TestClient]) -> None:
    response = failing(LogError("t goes back", "a.jsonl", 17)).get("/")
    assert assert_problem(response, 422) == "a.jsonl, line 17: t goes back"
    assert response.json()["line"] == 17


def test_other_expected_errors_are_422_and_413(failing: Callable[[Exception], TestClient]) -> None:
    assert assert_problem(failing(MapError("no image")).get("/"), 422) == "no image"
    assert assert_problem(failing(TooLargeError("too much")).get("/"), 413) == "too much"


def test_a_full_disk_is_507(failing: Callable[[Exception], TestClient]) -> None:
    import errno

    assert "disk is full" in assert_problem(failing(OSError(errno.ENOSPC, "x")).get("/"), 507)


def test_a_bug_is_500_and_tells_nothing_of_the_inside(
    failing: Callable[[Exception], TestClient],
) -> None:
    response = failing(KeyError("secret")).get("/")
    assert_problem(response, 500)
    assert "secret" not in response.text
    assert "Traceback" not in response.text
