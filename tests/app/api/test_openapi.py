"""The API is what CONTRACT names, and documents itself without the internet."""

from __future__ import annotations

import re

import pytest
from fastapi.testclient import TestClient

CONTRACT = [
    ("get", "/api/health"),
    ("post", "/api/logs"),
    ("get", "/api/logs"),
    ("get", "/api/logs/{log_id}"),
    ("delete", "/api/logs/{log_id}"),
    ("post", "/api/models"),
    ("post", "/api/models/import"),
    ("post", "/api/models/{model_id}/logs"),
    ("get", "/api/models"),
    ("get", "/api/models/{model_id}"),
    ("delete", "/api/models/{model_id}"),
    ("get", "/api/models/{model_id}/grid.png"),
    ("patch", "/api/models/{model_id}/nodes/{node_id}"),
    ("patch", "/api/models/{model_id}/rooms/{room_id}"),
    ("get", "/api/jobs/{job_id}"),
    ("get", "/api/jobs/{job_id}/events"),
    ("delete", "/api/jobs/{job_id}"),
]


@pytest.mark.parametrize(("method", "path"), CONTRACT)
def test_every_endpoint_of_the_contract_is_there(
    shared_client: TestClient, method: str, path: str
) -> None:
    assert method in shared_client.get("/openapi.json").json()["paths"][path]


def test_every_endpoint_has_a_summary_and_a_description(shared_client: TestClient) -> None:
    paths = shared_client.get("/openapi.json").json()["paths"]
    bare = [
        f"{method} {path}"
        for path, operations in paths.items()
        for method, operation in operations.items()
        if not (operation.get("summary") and operation.get("description"))
    ]
    assert bare == []


def test_uploads_are_described_as_forms(shared_client: TestClient) -> None:
    paths = shared_client.get("/openapi.json").json()["paths"]
    for path, parts in (("/api/logs", {"file", "ring"}), ("/api/models/import", {"yaml", "image"})):
        content = paths[path]["post"]["requestBody"]["content"]
        assert parts <= set(content["multipart/form-data"]["schema"]["properties"])


def test_the_docs_page_needs_nothing_from_elsewhere(shared_client: TestClient) -> None:
    page = shared_client.get("/docs")
    assert page.status_code == 200
    references = re.findall(r'(?:src|href)="([^"]+)"', page.text)
    assert references
    for reference in references:
        assert not re.match(r"(\w+:)?//", reference), reference
    for reference in ("docs/api/api.js", "docs/api/api.css"):
        assert reference in references
        answer = shared_client.get(f"/{reference}")
        assert answer.status_code == 200
        assert "http" not in answer.text


def test_errors_are_described_as_problem_documents(shared_client: TestClient) -> None:
    paths = shared_client.get("/openapi.json").json()["paths"]
    for path, operations in paths.items():
        for operation in operations.values():
            assert "application/problem+json" in operation["responses"]["4XX"]["content"], path
            assert "422" not in operation["responses"], path
