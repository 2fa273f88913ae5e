from __future__ import annotations


def test_a_model_compared_with_itself_has_no_differences(shared_client, shared_model) -> None:
    found = shared_client.get(f"/api/models/{shared_model}/comparison/{shared_model}")
    assert found.status_code == 200
    body = found.json()
    assert body["nodes"]
    assert all(pair["node"] == pair["other"] and pair["overlap"] == 1 for pair in body["nodes"])
    assert body["parameters"] == body["only_here"] == body["only_there"] == []
    assert body["free_overlap"] == 1


def test_a_model_that_is_not_there_is_said(shared_client, shared_model) -> None:
    found = shared_client.get(f"/api/models/{shared_model}/comparison/none")
    assert found.status_code == 404
    assert found.headers["content-type"] == "application/problem+json"
