"""Models on disk and in the index, without a server."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from app.errors import Conflict, NotFound
from app.events import ModelEvents
from app.storage.data_folder import DataFolder
from app.storage.database import Database
from app.storage.edit_history import HISTORY_FILE
from app.storage.model_facts import facts_of
from app.storage.model_files import ModelFiles
from app.storage.model_store import ModelStore
from app.storage.records import Status
from app.storage.search import Sorting


def write_folder(folder: Path, label: str | None = None) -> Path:
    """The part of a model folder that the store looks at."""
    folder.mkdir()
    node = {"id": "n1", "label": label, "area_m2": 4.5}
    topology = {"nodes": [node], "edges": [], "rooms": [{"id": "r1", "label": label}]}
    (folder / "topology.json").write_text(json.dumps(topology))
    (folder / "map.pgm").write_bytes(b"P5 1 1 255 \x00")
    return folder


class Home:
    """A data folder, opened and reopened."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.open()

    def open(self) -> None:
        self.folder = DataFolder(self.root)
        self.folder.open()
        self.database = Database(self.folder.database)
        self.models = ModelStore(self.database, self.folder, ModelEvents())

    def crash(self) -> None:
        """Ends everything without any tidying up, and starts again."""
        self.database.close()
        self.folder.close()
        self.open()
        self.models.recover("it was interrupted")

    def publish(self, model_id: str) -> None:
        made = write_folder(self.folder.temp / "made")
        self.models.publish(model_id, made, [], facts_of(made))


@pytest.fixture
def home(tmp_path: Path) -> Home:
    return Home(tmp_path / "data")


def relabel(label: str) -> Callable[[Path], str]:
    def edit(folder: Path) -> str:
        path = folder / "topology.json"
        topology = json.loads(path.read_text())
        topology["nodes"][0]["label"] = label
        path.write_text(json.dumps(topology))
        return f"named it {label}"

    return edit


def revisions_of(home: Home, model_id: str) -> list[str]:
    return sorted(p.name for p in (home.root / "models" / model_id).glob("0*"))


def test_a_new_model_has_no_files_until_it_is_published(home: Home) -> None:
    model = home.models.add("flat", {"regions": 2}, [])
    assert (model.status, model.revision) == (Status.QUEUED, 0)
    with pytest.raises(Conflict, match="not made yet"):
        home.models.folder(model.id)
    assert home.models.load(model.id) is None
    home.publish(model.id)
    done = home.models.get(model.id)
    assert (done.status, done.revision, done.nodes, done.area_m2) == (Status.DONE, 1, 1, 4.5)
    assert done.options == {"regions": 2}
    assert home.models.folder(model.id).name == "000001"


def test_an_edit_makes_a_revision_and_shares_what_it_leaves_alone(home: Home) -> None:
    model_id = home.models.add("flat", {}, []).id
    home.publish(model_id)
    before = (home.models.folder(model_id) / "map.pgm").stat().st_ino
    edited = home.models.edit(model_id, relabel("kitchen"))
    assert (edited.revision, edited.labels) == (2, ("kitchen",))
    assert (home.models.folder(model_id) / "map.pgm").stat().st_ino == before
    assert home.models.folder(model_id).name == "000002"


def test_an_edit_that_fails_changes_nothing(home: Home) -> None:
    model_id = home.models.add("flat", {}, []).id
    home.publish(model_id)

    def half(folder: Path) -> str:
        (folder / "topology.json").write_text("{")
        raise NotFound("node", "x")

    with pytest.raises(NotFound):
        home.models.edit(model_id, half)
    assert home.models.get(model_id).revision == 1
    assert facts_of(home.models.folder(model_id))["nodes"] == 1


def test_a_crash_before_an_edit_is_whole_leaves_the_model_as_it_was(home: Home) -> None:
    model_id = home.models.add("flat", {}, []).id
    home.publish(model_id)
    write_folder(home.root / "models" / model_id / "000002", "kitchen")
    home.crash()
    model = home.models.get(model_id)
    assert (model.revision, model.labels, model.status) == (1, (), Status.DONE)
    assert revisions_of(home, model_id) == ["000001"]
    assert home.models.edit(model_id, relabel("hall")).labels == ("hall",)


def test_a_crash_before_the_index_hears_of_an_edit_keeps_the_edit(home: Home) -> None:
    model_id = home.models.add("flat", {}, []).id
    home.publish(model_id)
    files = ModelFiles(home.folder)
    history = files.history(model_id)
    assert history is not None
    files.edit(model_id, history, relabel("kitchen"))
    home.crash()
    model = home.models.get(model_id)
    assert (model.revision, model.labels) == (2, ("kitchen",))
    assert home.models.undo(model_id).labels == ()


def test_a_model_of_an_earlier_version_begins_a_history(home: Home) -> None:
    model_id = home.models.add("flat", {}, []).id
    home.publish(model_id)
    (home.root / "models" / model_id / HISTORY_FILE).unlink()
    home.crash()
    assert home.models.edit(model_id, relabel("hall")).revision == 2


def test_after_a_crash_what_was_being_made_has_failed(home: Home) -> None:
    waiting = home.models.add("waiting", {}, []).id
    grown = home.models.add("grown", {}, []).id
    home.publish(grown)
    home.models.set_job(grown, "job")
    home.models.set_running(grown)
    assert home.models.get(grown).status is Status.RUNNING
    home.crash()
    assert home.models.get(waiting).status is Status.FAILED
    assert home.models.get(waiting).error == "it was interrupted"
    assert home.models.get(grown).status is Status.DONE
    assert home.models.get(grown).error == "it was interrupted"


def test_files_that_the_index_does_not_know_are_removed(home: Home) -> None:
    write_folder(home.root / "models" / "stranger")
    home.crash()
    assert list((home.root / "models").iterdir()) == []


def test_a_deleted_model_is_gone_and_its_id_stays_unknown(home: Home) -> None:
    model_id = home.models.add("flat", {}, []).id
    home.publish(model_id)
    home.models.delete(model_id)
    for use in (home.models.get, home.models.delete, home.models.folder):
        with pytest.raises(NotFound):
            use(model_id)
    assert home.models.search("", Sorting.of("name")) == []
