"""Beyond loopback every door asks for a token, one to write and one only to read."""

from __future__ import annotations

import re
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.access import ACCESS_FILE, Access, Right, Tokens, open_access, renew_tokens
from app.cli import run
from app.main import create_app
from app.settings import Settings
from app.token_guard import COOKIE, OPEN_PATHS
from core.errors import InputError

BASE = "http://127.0.0.1:8000"


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> tuple[Access, Tokens, Path]:
    data = tmp_path_factory.mktemp("access")
    access, tokens = open_access(data)
    assert tokens is not None
    return access, tokens, data


@pytest.fixture(scope="module")
def guarded(opened: tuple[Access, Tokens, Path]) -> Iterator[TestClient]:
    access, _, data = opened
    settings = Settings(host="0.0.0.0", data=data, warm_workers=0)
    with TestClient(create_app(settings, access), base_url=BASE, follow_redirects=False) as client:
        yield client


def bearer(token: str) -> dict[str, str]:
    return {"authorization": f"Bearer {token}"}


def test_tokens_are_told_once_and_kept_as_hashes(opened: tuple[Access, Tokens, Path]) -> None:
    _, tokens, data = opened
    again, fresh = open_access(data)
    assert fresh is None
    assert again.right_of(tokens.write) is Right.WRITE
    assert again.right_of(tokens.read) is Right.READ
    kept = (data / ACCESS_FILE).read_text()
    assert tokens.write not in kept
    assert tokens.read not in kept
    assert stat.S_IMODE((data / ACCESS_FILE).stat().st_mode) == 0o600


@pytest.mark.parametrize("token", [None, "", "guess", "é\udcff", "x" * 10_000])
def test_anything_else_allows_nothing(
    opened: tuple[Access, Tokens, Path], token: str | None
) -> None:
    assert opened[0].right_of(token) is Right.NOTHING


def test_renewed_tokens_end_those_before(tmp_path: Path) -> None:
    _, before = open_access(tmp_path)
    after = renew_tokens(tmp_path)
    access, _ = open_access(tmp_path)
    assert before is not None
    assert access.right_of(before.write) is Right.NOTHING
    assert access.right_of(after.write) is Right.WRITE


def test_a_damaged_file_is_said(tmp_path: Path) -> None:
    (tmp_path / ACCESS_FILE).write_text("{")
    with pytest.raises(InputError, match="echorooms token"):
        open_access(tmp_path)


def test_the_command_shows_both_tokens(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["token", "--data", str(tmp_path)]) == 0
    told = dict(line.split(": ") for line in capsys.readouterr().out.splitlines())
    access, fresh = open_access(tmp_path)
    assert fresh is None
    assert access.right_of(told["writing"]) is Right.WRITE
    assert access.right_of(told["reading"]) is Right.READ


def every_route(client: TestClient) -> list[tuple[str, str]]:
    """Method and path of everything in the API's description, and pages beside it."""
    paths = client.app.openapi()["paths"]  # type: ignore[attr-defined]
    found = [(m.upper(), re.sub(r"\{\w+\}", "x", p)) for p, ways in paths.items() for m in ways]
    return [*found, ("GET", "/"), ("GET", "/js/main.js"), ("GET", "/view/x/"), ("GET", "/docs")]


def test_no_door_opens_without_a_token(guarded: TestClient) -> None:
    routes = [r for r in every_route(guarded) if r[1] not in OPEN_PATHS]
    assert len(routes) > 30
    for method, path in routes:
        answer = guarded.request(method, path)
        assert answer.status_code == 401, (method, path)
        assert answer.headers["www-authenticate"] == "Bearer"
        assert answer.headers["content-type"] == "application/problem+json"


def test_the_reading_token_changes_nothing(
    guarded: TestClient, opened: tuple[Access, Tokens, Path]
) -> None:
    headers = bearer(opened[1].read)
    assert guarded.get("/api/models", headers=headers).json() == []
    for method, path in every_route(guarded):
        if method not in ("GET", "HEAD"):
            assert guarded.request(method, path, headers=headers).status_code == 403, (method, path)


def test_the_writing_token_changes_things(
    guarded: TestClient, opened: tuple[Access, Tokens, Path]
) -> None:
    nothing = {"log_id": "nothing"}
    answer = guarded.post("/api/models", json=nothing, headers=bearer(opened[1].write))
    assert answer.status_code == 422


def close_code(client: TestClient, path: str, headers: dict[str, str] | None = None) -> int:
    """The code with which a WebSocket is closed at once."""
    try:
        with client.websocket_connect(
            f"ws://127.0.0.1:8000{path}", headers=headers or {}
        ) as socket:
            socket.receive_text()
    except WebSocketDisconnect as closed:
        return closed.code
    return pytest.fail(f"{path} stays open")


@pytest.mark.parametrize(
    "path", ["/api/live/x/scans", "/api/live/x/events", "/view/x/events", "/view/x"]
)
def test_no_socket_opens_without_a_token(guarded: TestClient, path: str) -> None:
    assert close_code(guarded, f"{path}?tab=tab-one-0001") == 1008


def test_the_reading_token_hears_but_sends_no_scans(
    guarded: TestClient, opened: tuple[Access, Tokens, Path]
) -> None:
    headers = bearer(opened[1].read)
    assert close_code(guarded, "/api/live/x/events", headers) == 4404
    assert close_code(guarded, "/api/live/x/scans", headers) == 1008


def test_a_person_logs_in_with_a_form_and_gets_a_cookie_that_scripts_cannot_read(
    guarded: TestClient, opened: tuple[Access, Tokens, Path]
) -> None:
    page = guarded.get("/", headers={"accept": "text/html"})
    assert (page.status_code, page.headers["location"]) == (303, "/login")
    assert "<form" in guarded.get("/login").text
    wrong = guarded.post("/login", data={"token": "guess"})
    assert wrong.status_code == 401
    assert COOKIE not in wrong.cookies
    right = guarded.post("/login", data={"token": opened[1].read})
    assert (right.status_code, right.headers["location"]) == (303, "/")
    cookie = right.headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert guarded.get("/", headers={"accept": "text/html"}).status_code == 200
    beside = {"cookie": f'prefs={{"a":1}}; {COOKIE}={opened[1].read}'}
    assert guarded.get("/api/models", headers=beside).status_code == 200
    guarded.get("/logout")
    assert guarded.get("/api/models").status_code == 401
    guarded.cookies.clear()


def test_a_page_of_another_site_cannot_log_anybody_in(
    guarded: TestClient, opened: tuple[Access, Tokens, Path]
) -> None:
    evil: dict[str, Any] = {"origin": "http://evil.example"}
    answer = guarded.post("/login", data={"token": opened[1].read}, headers=evil)
    assert answer.status_code == 403


def test_on_loopback_everything_is_open(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, warm_workers=0)
    with TestClient(create_app(settings), base_url=BASE) as client:
        assert client.get("/api/models").status_code == 200
