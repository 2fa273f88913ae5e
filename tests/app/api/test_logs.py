"""Logs over HTTP."""

from __future__ import annotations

import gzip
import io
import json
import threading
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.settings import Settings

Upload = Callable[..., dict[str, Any]]


def post(client: TestClient, content: bytes, name: str = "drive.jsonl", **fields: str) -> Any:
    return client.post("/api/logs", files={"file": (name, content)}, data=fields)


def names(client: TestClient, query: str = "") -> list[str]:
    return [log["name"] for log in client.get(f"/api/logs{query}").json()]


def leftovers(settings: Settings) -> list[Path]:
    """What lies in the data folder's temporary place."""
    return list((settings.data / "temp").iterdir())


def test_an_uploaded_log_is_told_with_its_figures(
    client: TestClient, upload: Upload, make_log: Callable[..., bytes]
) -> None:
    log = upload(client, make_log(scans=80, name="flat"))
    assert log["name"] == "flat"
    assert log["scans"] == 80
    assert log["sonars"] == 8
    assert log["duration_s"] == pytest.approx(79 * 0.25)
    assert log["distance_m"] == pytest.approx(79 * 2 * 3.14159265 / 80, rel=1e-3)
    assert log["report"]["scans"] == 80
    assert log["size_bytes"] > 1000
    assert client.get(f"/api/logs/{log['id']}").json() == log


def test_the_upload_is_kept_as_it_came(
    client: TestClient, settings: Settings, make_log: Callable[..., bytes]
) -> None:
    content = make_log()
    log = post(client, content, "my drive.jsonl").json()
    original = settings.data / "logs" / log["id"] / "original" / "my drive.jsonl"
    assert original.read_bytes() == content
    assert leftovers(settings) == []


def test_logs_are_found_by_words_and_sorted(
    client: TestClient, upload: Upload, make_log: Any
) -> None:
    for name, scans in (("Old house", 30), ("new House 100%", 20), ("garage", 40)):
        upload(client, make_log(scans=scans, name=name))
    assert names(client) == ["garage", "new House 100%", "Old house"]
    assert names(client, "?sort=scans") == ["new House 100%", "Old house", "garage"]
    assert names(client, "?q=house&sort=name") == ["Old house", "new House 100%"]
    assert names(client, "?q=house+old") == ["Old house"]
    assert names(client, "?q=0%25") == ["new House 100%"]
    assert names(client, "?q=%25") == ["new House 100%"]


def test_a_log_is_renamed_and_the_name_is_trimmed(client: TestClient, upload: Upload) -> None:
    log = upload(client)
    answer = client.patch(f"/api/logs/{log['id']}", json={"name": "  ground floor "})
    assert answer.json()["name"] == "ground floor"
    assert names(client) == ["ground floor"]
    assert client.patch(f"/api/logs/{log['id']}", json={"name": "  "}).status_code == 422
    assert client.patch(f"/api/logs/{log['id']}", json={"name": "a\nb"}).status_code == 422


def test_a_deleted_log_is_gone_with_its_files(
    client: TestClient, upload: Upload, settings: Settings
) -> None:
    log = upload(client)
    assert client.delete(f"/api/logs/{log['id']}").status_code == 204
    assert client.get(f"/api/logs/{log['id']}").status_code == 404
    assert client.delete(f"/api/logs/{log['id']}").status_code == 404
    assert list((settings.data / "logs").iterdir()) == []


@pytest.mark.parametrize(
    "name",
    [
        "../../escape.jsonl",
        "..\\..\\escape.jsonl",
        "/etc/passwd",
        "..",
        "",
        "a\x00b.jsonl",
        "C:\\con|x.jsonl",
        "x" * 500 + ".jsonl",
        "ключ.jsonl",
    ],
)
def test_no_file_name_leaves_the_folder_of_its_log(
    shared_client: TestClient, shared_settings: Settings, make_log: Any, name: str
) -> None:
    response = post(shared_client, make_log(), name)
    if response.status_code == 201:
        (kept,) = (shared_settings.data / "logs" / response.json()["id"] / "original").iterdir()
        assert kept.is_file()
        assert len(kept.name) <= 60
    else:
        assert response.status_code == 422
    outside = [p for p in shared_settings.data.parent.iterdir() if p != shared_settings.data]
    assert outside == []


def test_a_zip_with_a_log_yaml_is_a_log(shared_client: TestClient) -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("log.yaml", "files: nonsense\n")
    response = post(shared_client, packed.getvalue(), "corridor.zip")
    assert response.status_code == 422
    assert "log.yaml" in response.json()["detail"]


def test_the_ring_is_a_preset_or_a_text_but_never_a_file_of_the_server(
    shared_client: TestClient, make_log: Any, tmp_path: Path
) -> None:
    secret = tmp_path / "ring.yaml"
    secret.write_text("robot: {radius: 0.2}\nsonars: [{x: 0, y: 0, heading: 0}]\n")
    assert post(shared_client, make_log(), ring="paper-12").status_code in (201, 422)
    response = post(shared_client, make_log(), ring=str(secret))
    assert response.status_code == 422
    assert "ring" in response.json()["detail"]


def test_concurrent_uploads_all_arrive(client: TestClient, make_log: Any) -> None:
    answers: list[int] = []

    def send(index: int) -> None:
        answers.append(post(client, make_log(name=f"drive {index}")).status_code)

    threads = [threading.Thread(target=send, args=(i,)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == [201] * 6
    assert sorted(names(client)) == [f"drive {i}" for i in range(6)]


def test_a_form_without_a_file_or_no_form_at_all_is_told(shared_client: TestClient) -> None:
    assert (
        "file"
        in shared_client.post("/api/logs", data={"ring": "x"}, files={"other": b"y"}).json()[
            "detail"
        ]
    )
    assert shared_client.post("/api/logs", content=b"hello").status_code == 415
    broken = shared_client.post(
        "/api/logs",
        content=b"--x\r\nno header",
        headers={"content-type": "multipart/form-data; boundary=x"},
    )
    assert broken.status_code == 400


def test_an_upload_over_the_limit_is_413(tmp_path: Path, make_log: Any) -> None:
    from app.main import create_app

    settings = Settings(data=tmp_path / "small", max_upload_mb=1, warm_workers=0)
    with TestClient(create_app(settings), base_url="http://127.0.0.1") as client:
        response = post(client, b"x" * (2 << 20))
        assert response.status_code == 413
        assert "1 MB" in response.json()["detail"]
        stream = (b"x" * 65536 for _ in range(64))
        headers = {"content-type": "multipart/form-data; boundary=b"}
        assert client.post("/api/logs", content=stream, headers=headers).status_code in (400, 413)
        assert leftovers(settings) == []


def _scan(**changes: Any) -> bytes:
    scan = {"t": 1.0, "odom": [0, 0, 0], "ranges": [1.0] * 8} | changes
    return json.dumps(scan).encode() + b"\n"


def _bad_inputs(log: bytes) -> dict[str, tuple[bytes, set[int]]]:
    """Hostile and unlucky uploads, with the answers that are allowed."""
    header = log.split(b"\n", 1)[0] + b"\n"
    many = json.loads(header)
    many["sonars"] = [many["sonars"][0]] * 200_000
    png = b"\x89PNG\r\n\x1a\n" + b"\x00" * 200
    return {
        "empty": (b"", {422}),
        "half a gzip": (gzip.compress(log)[: len(gzip.compress(log)) // 2], {422}),
        "wrong number of ranges": (header + _scan(ranges=[1.0]), {422}),
        "a pose that is NaN": (header + _scan(odom=[0, float("nan"), 0]), {422}),
        "time running backwards": (header + _scan(t=5) + _scan(t=1) + _scan(t=0.5), {201, 422}),
        "a PNG": (png, {422}),
        "200,000 sonars": (json.dumps(many).encode() + b"\n", {413, 422}),
        "coordinates of 1e12": (header + _scan(odom=[1e12, 0, 0]), {422}),
        "a header alone": (header, {422}),
        "a line of 3 MB": (header + b'{"t": 1, "x": "' + b"x" * 3_000_000 + b'"}\n', {413, 422}),
        "deep nesting": (header + b"[" * 100_000 + b"\n", {422}),
        "numbers as text": (header + _scan(t="now"), {422}),
    }


@pytest.mark.parametrize("kind", _bad_inputs(b'{"sonars": [0]}\n'))
def test_bad_input_is_answered_with_one_line(
    shared_client: TestClient, make_log: Any, kind: str
) -> None:
    content, allowed = _bad_inputs(make_log())[kind]
    response = post(shared_client, content)
    assert response.status_code in allowed, response.text
    if response.status_code != 201:
        problem = response.json()
        assert "\n" not in problem["detail"]
        assert "Traceback" not in problem["detail"]
        assert "drive.jsonl" in problem["detail"]


def test_an_error_names_the_line_that_is_wrong(shared_client: TestClient, make_log: Any) -> None:
    lines = make_log(scans=40).splitlines(keepends=True)
    lines[17] = b'{"t": 4.0, "odom": [0, 0], "ranges": []}\n'
    problem = post(shared_client, b"".join(lines)).json()
    assert problem["line"] == 18
    assert "line 18" in problem["detail"]


def test_nan_as_no_echo_and_one_scan_are_accepted(shared_client: TestClient, make_log: Any) -> None:
    header = make_log().split(b"\n", 1)[0] + b"\n"
    response = post(shared_client, header + _scan(ranges=[float("nan")] * 8))
    assert response.status_code == 201
    assert response.json()["scans"] == 1


@pytest.mark.slow
def test_a_gzip_of_a_million_scans_is_refused(shared_client: TestClient, make_log: Any) -> None:
    ten_megabytes = gzip.compress(_scan() * 170_000)
    bomb = gzip.compress(make_log()) + ten_megabytes * 300
    assert post(shared_client, bomb).status_code == 413
