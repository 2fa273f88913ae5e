"""Who may talk to the server from a browser."""

from __future__ import annotations

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.security import host_allowed, origin_allowed
from app.settings import Settings

LOCAL = Settings(host="127.0.0.1")
PUBLIC = Settings(host="0.0.0.0", allowed_hosts=("robots.example",))


@pytest.mark.parametrize(
    "host", ["localhost:8000", "127.0.0.1", "[::1]:80", "127.0.0.2:1", "LOCALHOST"]
)
def test_loopback_names_are_always_answered(host: str) -> None:
    assert host_allowed({"host": host}, LOCAL)
    assert host_allowed({"host": host}, PUBLIC)


@pytest.mark.parametrize(
    "host", ["evil.example", "192.168.1.5:8000", "", "localhost.evil.example", "[::1", "a@b:x"]
)
def test_a_local_server_answers_to_no_other_name(host: str) -> None:
    assert not host_allowed({"host": host}, LOCAL)


def test_a_public_server_answers_to_addresses_and_configured_names() -> None:
    assert host_allowed({"host": "192.168.1.5:8000"}, PUBLIC)
    assert host_allowed({"host": "robots.example"}, PUBLIC)
    assert not host_allowed({"host": "rebound.example:8000"}, PUBLIC)


def test_a_page_of_the_server_itself_may_change_things() -> None:
    headers = {"host": "localhost:8000", "origin": "http://localhost:8000"}
    assert origin_allowed(headers, LOCAL)


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://localhost:9000", "", "file://"]
)
def test_pages_of_other_origins_may_not(origin: str) -> None:
    assert not origin_allowed({"host": "localhost:8000", "origin": origin}, LOCAL)


def test_programs_that_send_no_origin_may_unless_a_browser_says_cross_site() -> None:
    assert origin_allowed({"host": "localhost"}, LOCAL)
    assert not origin_allowed({"host": "localhost", "sec-fetch-site": "cross-site"}, LOCAL)


def test_configured_origins_may() -> None:
    settings = Settings(allowed_origins=("https://home.example",))
    headers = {"host": "localhost", "origin": "https://home.example"}
    assert origin_allowed(headers, settings)


def test_a_foreign_host_gets_a_problem_and_no_data(shared_client: TestClient) -> None:
    response = shared_client.get("/api/logs", headers={"host": "evil.example"})
    assert response.status_code == 403
    assert response.headers["content-type"] == "application/problem+json"
    assert "evil.example" in response.json()["detail"]


def test_a_foreign_page_cannot_upload_or_delete(shared_client: TestClient) -> None:
    headers = {"origin": "http://evil.example"}
    files = {"file": ("a.jsonl", b"x")}
    assert shared_client.post("/api/logs", files=files, headers=headers).status_code == 403
    assert shared_client.delete("/api/models/1", headers=headers).status_code == 403


def test_a_foreign_page_cannot_open_a_websocket(shared_client: TestClient) -> None:
    headers = {"origin": "http://evil.example"}
    with (
        pytest.raises(WebSocketDisconnect) as refused,
        shared_client.websocket_connect("/view/any", headers=headers),
    ):
        pass
    assert refused.value.code == 1008


def test_every_answer_carries_the_security_headers(shared_client: TestClient) -> None:
    for path in ("/", "/api/health", "/api/nothing", "/docs"):
        headers = shared_client.get(path).headers
        assert "default-src 'self'" in headers["content-security-policy"], path
        assert headers["x-content-type-options"] == "nosniff", path


def test_answers_of_the_api_are_never_kept_by_a_browser(shared_client: TestClient) -> None:
    assert shared_client.get("/api/logs").headers["cache-control"] == "no-store"
    assert shared_client.get("/").headers["cache-control"] == "no-cache"
