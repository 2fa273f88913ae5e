"""The page of the 3D view."""

from __future__ import annotations

import httpx2
import pytest

from app.viewer.page import CONTENT_POLICY


@pytest.fixture
def client(server):
    with httpx2.Client(base_url=f"http://127.0.0.1:{server.port}", timeout=10) as client:
        yield client


def test_the_page_is_visers_with_our_script_before_its_own(client):
    answer = client.get("/view/m1/")
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/html")
    assert answer.text.index("document.hasFocus =") < answer.text.index("</head>")
    assert answer.text.index("document.hasFocus =") < answer.text.index("<title>")


def test_it_has_its_own_content_policy(client):
    assert client.get("/view/m1/").headers["content-security-policy"] == CONTENT_POLICY


def test_it_is_compressed_and_not_sent_twice(client):
    first = client.get("/view/m1/")
    assert first.headers["content-encoding"] == "gzip"
    etag = first.headers["etag"]
    second = client.get("/view/m1/", headers={"if-none-match": etag})
    assert second.status_code == 304
    assert second.content == b""
    plain = client.get("/view/m1/", headers={"accept-encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert plain.text == first.text


def test_every_tab_has_an_address_of_its_own(client):
    assert client.get("/view/m1/tab/0123456789abcdef/").status_code == 200
    assert client.get("/view/m1/tab/short/").status_code == 422


def test_the_address_without_its_last_slash_leads_there(client):
    answer = client.get("/view/m1", follow_redirects=True)
    assert answer.status_code == 200
    assert answer.url.path == "/view/m1/"


def test_an_unknown_model_has_no_page(client):
    answer = client.get("/view/nothing/")
    assert answer.status_code == 404
    assert "nothing" in answer.json()["detail"]
