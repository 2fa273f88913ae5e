"""Bodies that are too long."""

from __future__ import annotations

from fastapi.testclient import TestClient

from app.body_limit import MAX_BODY_BYTES

JSON = {"content-type": "application/json"}


def test_a_json_body_over_the_limit_is_413_also_without_a_length(shared_client: TestClient) -> None:
    body = b'{"log_id": "' + b"x" * MAX_BODY_BYTES + b'"}'
    assert shared_client.post("/api/models", content=body, headers=JSON).status_code == 413
    chunks = (body[i : i + 65536] for i in range(0, len(body), 65536))
    response = shared_client.post("/api/models", content=chunks, headers=JSON)
    assert response.status_code == 413
    assert response.headers["content-type"] == "application/problem+json"
    assert "8 MB" in response.json()["detail"]


def test_a_json_body_just_below_the_limit_is_looked_at(shared_client: TestClient) -> None:
    body = b'{"log_id": "' + b"x" * (MAX_BODY_BYTES - 20) + b'"}'
    assert shared_client.post("/api/models", content=body, headers=JSON).status_code == 422
