"""Models over HTTP."""

from __future__ import annotations

import gzip
import io
import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient
from PIL import Image

from app.settings import Settings

Upload = Callable[..., dict[str, Any]]
MakeModel = Callable[..., str]
Wait = Callable[..., dict[str, Any]]


def test_a_model_tells_its_topology_status_and_provenance(
    shared_client: TestClient, shared_model: str
) -> None:
    model = shared_client.get(f"/api/models/{shared_model}").json()
    assert model["status"] == "done"
    assert model["format"] == "echorooms-topology"
    assert model["version"] == 1
    assert len(model["nodes"]) == model["node_count"] == 3
    assert {room["id"] for room in model["rooms"]}
    nodes = {node["id"] for node in model["nodes"]}
    assert model["edges"]
    assert {e["source"] for e in model["edges"]} | {e["target"] for e in model["edges"]} <= nodes
    assert model["area_m2"] == pytest.approx(sum(n["area_m2"] for n in model["nodes"]))
    assert model["provenance"]["options"]["regions"] == 3
    assert model["options"] == {
        "mode": "offline",
        "regions": 3,
        "method": "default",
        "mapping": "cemal",
        "resolution": 0.05,
    }


def test_a_model_is_called_like_its_log_unless_told_otherwise(
    shared_client: TestClient, upload: Upload, make_log: Any
) -> None:
    log = upload(shared_client, make_log(name="flat"))
    body = {"log_id": log["id"], "regions": 2}
    unnamed = shared_client.post("/api/models", json=body).json()["id"]
    named = shared_client.post("/api/models", json=body | {"name": " attic "}).json()["id"]
    assert shared_client.get(f"/api/models/{unnamed}").json()["name"] == "flat"
    assert shared_client.get(f"/api/models/{named}").json()["name"] == "attic"
    answer = shared_client.patch(f"/api/models/{named}", json={"name": "loft"})
    assert answer.json()["name"] == "loft"
    found = shared_client.get("/api/models?q=LOF").json()
    assert [model["name"] for model in found] == ["loft"]


def test_the_grid_picture_shows_the_mapped_room(
    shared_client: TestClient, shared_model: str
) -> None:
    response = shared_client.get(f"/api/models/{shared_model}/grid.png")
    assert response.headers["content-type"] == "image/png"
    pixels = np.asarray(Image.open(io.BytesIO(response.content)))
    assert set(np.unique(pixels)) <= {0, 205, 254}
    assert (pixels == 254).sum() * 0.05**2 == pytest.approx(4.0 * 4.0, rel=0.2)


def test_a_log_in_use_cannot_be_deleted_until_its_model_is(
    shared_client: TestClient, upload: Upload, make_model: MakeModel, shared_settings: Settings
) -> None:
    log = upload(shared_client)["id"]
    model = make_model(shared_client, log)
    refused = shared_client.delete(f"/api/logs/{log}")
    assert refused.status_code == 409
    assert "square room" in refused.json()["detail"]
    assert shared_client.delete(f"/api/models/{model}").status_code == 204
    assert shared_client.get(f"/api/models/{model}").status_code == 404
    assert not (shared_settings.data / "models" / model).exists()
    assert shared_client.delete(f"/api/logs/{log}").status_code == 204


def test_a_model_of_no_log_is_refused(shared_client: TestClient) -> None:
    response = shared_client.post("/api/models", json={"log_id": "0123456789abcdef", "regions": 2})
    assert response.status_code == 422
    assert "log_id" in response.json()["detail"]


def test_a_job_that_cannot_succeed_fails_with_the_reason_and_leaves_no_files(
    shared_client: TestClient,
    upload: Upload,
    wait_for_job: Wait,
    make_log: Any,
    shared_settings: Settings,
) -> None:
    deaf = b"".join(
        line
        if i == 0
        else line.split(b'"ranges"')[0]
        + b'"ranges": '
        + b"[null,null,null,null,null,null,null,null]}\n"
        for i, line in enumerate(make_log(scans=20).splitlines(keepends=True))
    )
    log = upload(shared_client, deaf)["id"]
    accepted = shared_client.post("/api/models", json={"log_id": log, "regions": 2}).json()
    job = wait_for_job(shared_client, accepted["job_id"])
    model = shared_client.get(f"/api/models/{accepted['id']}").json()
    assert job["status"] == model["status"] == "failed"
    assert "echo" in job["error"]
    assert model["error"] == job["error"]
    assert model["nodes"] == []
    assert shared_client.get(f"/api/models/{accepted['id']}/grid.png").status_code == 409
    assert not (shared_settings.data / "models" / accepted["id"]).exists()


def test_a_drive_goes_on_with_another_log_and_keeps_its_labels(
    shared_client: TestClient,
    upload: Upload,
    make_model: MakeModel,
    make_log: Any,
    wait_for_job: Wait,
) -> None:
    first = upload(shared_client, make_log(scans=80))["id"]
    second = upload(shared_client, make_log(scans=80, start_t=20.0))["id"]
    model = make_model(shared_client, first, regions=2)
    before = shared_client.get(f"/api/models/{model}").json()
    node = before["nodes"][0]
    shared_client.patch(f"/api/models/{model}/nodes/{node['id']}", json={"label": "den"})
    accepted = shared_client.post(f"/api/models/{model}/logs", json={"log_id": second})
    assert accepted.status_code == 202
    assert accepted.json()["id"] == model
    assert wait_for_job(shared_client, accepted.json()["job_id"])["status"] == "done"
    after = shared_client.get(f"/api/models/{model}").json()
    assert after["log_ids"] == [first, second]
    assert after["labels"] == ["den"]
    (labelled,) = [n for n in after["nodes"] if n["label"] == "den"]
    assert np.hypot(*np.subtract(labelled["position"], node["position"])) < 1.0
    assert shared_client.delete(f"/api/logs/{second}").status_code == 409


def test_a_log_of_another_drive_fails_and_leaves_the_model_as_it_was(
    shared_client: TestClient,
    upload: Upload,
    make_model: MakeModel,
    make_log: Any,
    wait_for_job: Wait,
) -> None:
    first, other = upload(shared_client)["id"], upload(shared_client, make_log(name="other"))["id"]
    model = make_model(shared_client, first)
    before = shared_client.get(f"/api/models/{model}").json()
    assert (
        shared_client.post(f"/api/models/{model}/logs", json={"log_id": first}).status_code == 422
    )
    accepted = shared_client.post(f"/api/models/{model}/logs", json={"log_id": other}).json()
    job = wait_for_job(shared_client, accepted["job_id"])
    after = shared_client.get(f"/api/models/{model}").json()
    assert job["status"] == "failed"
    assert after["status"] == "done"
    assert after["error"] == job["error"]
    assert after["nodes"] == before["nodes"]
    assert after["log_ids"] == [first]
    assert shared_client.delete(f"/api/logs/{other}").status_code == 204


def two_rooms() -> Any:
    """Two rooms of 4 m x 4 m with a door, and something in the upper left corner (row 0 at the top)."""
    pixels = np.full((90, 170), 205, np.uint8)
    pixels[3:87, 3:167] = 0
    pixels[5:85, 5:85] = pixels[5:85, 87:165] = 254
    pixels[40:56, 85:87] = 254
    pixels[5:10, 5:10] = 0
    return pixels


def map_files(name: str = "map.png", **changes: Any) -> dict[str, tuple[str, bytes]]:
    """The two rooms as map_server files."""
    image = io.BytesIO()
    Image.fromarray(two_rooms()).save(image, "PNG")
    header = {
        "image": name,
        "resolution": 0.05,
        "origin": "[0.0, 0.0, 0.0]",
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    } | changes
    text = "".join(f"{key}: {value}\n" for key, value in header.items())
    return {"yaml": ("flat.yaml", text.encode()), "image": ("map.png", image.getvalue())}


def test_an_imported_map_becomes_a_model(shared_client: TestClient, wait_for_job: Wait) -> None:
    accepted = shared_client.post("/api/models/import", files=map_files(), data={"regions": "2"})
    assert accepted.status_code == 202, accepted.text
    assert wait_for_job(shared_client, accepted.json()["job_id"])["status"] == "done"
    model = shared_client.get(f"/api/models/{accepted.json()['id']}").json()
    assert model["name"] == "flat"
    assert model["log_ids"] == []
    assert len(model["nodes"]) == 2
    (edge,) = model["edges"]
    assert edge["doorway"] == pytest.approx([4.3, 2.1], abs=0.2)
    assert edge["width_m"] == pytest.approx(0.8, abs=0.15)
    picture = shared_client.get(f"/api/models/{model['id']}/grid.png").content
    assert np.array_equal(np.asarray(Image.open(io.BytesIO(picture))), two_rooms())
    log = shared_client.post(f"/api/models/{model['id']}/logs", json={"log_id": "x"})
    assert log.status_code == 422


def test_the_image_entry_of_an_imported_map_is_not_followed(
    shared_client: TestClient, wait_for_job: Wait, tmp_path: Path
) -> None:
    for name in ("/etc/passwd", "../../../secret.png"):
        files = map_files(name=name)
        accepted = shared_client.post(
            "/api/models/import", files=files, data={"regions": "2"}
        ).json()
        assert wait_for_job(shared_client, accepted["job_id"])["status"] == "done"


@pytest.mark.parametrize(
    ("files", "fields", "words"),
    [
        (map_files(), {"regions": "0"}, "regions"),
        (map_files(), {"regions": "many"}, "regions"),
        (map_files(), {"surprise": "1"}, "surprise"),
        (map_files(), {"method": "paper"}, "number of regions"),
        (map_files(resolution=-1), {}, "resolution"),
        (map_files(resolution="wide"), {}, "resolution"),
        (map_files() | {"yaml": ("m.yaml", b"- just\n- a list\n")}, {}, "map.yaml"),
        (map_files() | {"yaml": ("m.yaml", b"a: &x [1]\nb: [*x, *x]\n")}, {}, "alias"),
        (map_files() | {"image": ("map.png", b"no picture")}, {}, "map.png"),
        ({"yaml": map_files()["yaml"]}, {}, "image"),
    ],
)
def test_a_wrong_import_is_refused_at_once(
    shared_client: TestClient, files: Any, fields: dict[str, str], words: str
) -> None:
    known = len(shared_client.get("/api/models").json())
    response = shared_client.post("/api/models/import", files=files, data=fields)
    assert response.status_code == 422, response.text
    assert words in response.json()["detail"]
    assert len(shared_client.get("/api/models").json()) == known


def test_a_picture_of_a_billion_pixels_is_413(shared_client: TestClient) -> None:
    image = io.BytesIO()
    Image.new("1", (30_000, 30_000)).save(image, "PNG")
    files = map_files() | {"image": ("map.png", image.getvalue())}
    response = shared_client.post("/api/models/import", files=files)
    assert response.status_code in (413, 422)
    assert "pixels" in response.json()["detail"]


def test_a_model_made_again_takes_the_labels_of_an_earlier_one_along(
    shared_client: TestClient, upload: Upload, make_model: MakeModel, wait_for_job: Wait
) -> None:
    log = upload(shared_client)["id"]
    first = make_model(shared_client, log, regions=2)
    node = shared_client.get(f"/api/models/{first}").json()["nodes"][1]
    shared_client.patch(f"/api/models/{first}/nodes/{node['id']}", json={"label": "study"})
    body = {"log_id": log, "regions": 2, "mapping": "bayes", "labels_from": first}
    accepted = shared_client.post("/api/models", json=body).json()
    assert wait_for_job(shared_client, accepted["job_id"])["status"] == "done"
    again = shared_client.get(f"/api/models/{accepted['id']}").json()
    (labelled,) = [n for n in again["nodes"] if n["label"] == "study"]
    closest = min(
        again["nodes"], key=lambda n: np.hypot(*np.subtract(n["position"], node["position"]))
    )
    assert labelled == closest
    assert again["options"]["mapping"] == "bayes"
    body["labels_from"] = "0123456789abcdef"
    refused = shared_client.post("/api/models", json=body)
    assert refused.status_code == 422
    assert "labels_from" in refused.json()["detail"]


def test_a_model_folder_and_a_log_can_be_taken_away(
    shared_client: TestClient, shared_model: str
) -> None:
    answer = shared_client.get(f"/api/models/{shared_model}/folder.zip")
    with zipfile.ZipFile(io.BytesIO(answer.content)) as archive:
        names = set(archive.namelist())
        topology = json.loads(archive.read("topology.json"))
    assert {"map.yaml", "map.pgm", "regions.png", "rooms.png", "trajectory.csv"} <= names
    assert {"topology.json", "provenance.json", "history.jsonl"} <= names
    model = shared_client.get(f"/api/models/{shared_model}").json()
    assert [n["id"] for n in topology["nodes"]] == [n["id"] for n in model["nodes"]]
    log = shared_client.get(f"/api/logs/{model['log_ids'][0]}/file")
    assert gzip.decompress(log.content).count(b"\n") == 81
    assert shared_client.get("/api/models/0123456789abcdef/folder.zip").status_code == 404
