"""Files that appear whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.storage.data_folder import DataFolder, new_id, size_on_disk
from core.errors import InputError


@pytest.fixture
def folder(tmp_path: Path) -> DataFolder:
    folder = DataFolder(tmp_path / "data")
    folder.open()
    return folder


def test_a_published_folder_appears_at_its_place_and_leaves_the_temporary_one(
    folder: DataFolder,
) -> None:
    place = folder.logs / "a"
    with folder.temporary() as temp:
        (temp / "made" / "inner").mkdir(parents=True)
        (temp / "made" / "inner" / "file").write_text("12345")
        folder.publish(temp / "made", place)
    assert (place / "inner" / "file").read_text() == "12345"
    assert list(folder.temp.iterdir()) == []
    assert size_on_disk(place) == 5


def test_what_is_not_published_is_removed_even_after_an_error(folder: DataFolder) -> None:
    def fail() -> None:
        with folder.temporary() as temp:
            (temp / "half").write_text("x")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert list(folder.temp.iterdir()) == []


def test_what_a_crash_left_is_removed_at_the_next_start(folder: DataFolder) -> None:
    (folder.temp / "left" / "over").mkdir(parents=True)
    (folder.logs / "kept").mkdir()
    folder.close()
    again = DataFolder(folder.root)
    again.open()
    assert list(again.temp.iterdir()) == []
    assert (again.logs / "kept").is_dir()


def test_discarding_removes_and_can_be_repeated(folder: DataFolder) -> None:
    place = folder.models / "a"
    place.mkdir()
    (place / "file").write_text("x")
    folder.discard(place)
    folder.discard(place)
    assert not place.exists()
    assert list(folder.temp.iterdir()) == []


def test_a_folder_is_used_by_one_server_at_a_time(folder: DataFolder) -> None:
    with pytest.raises(InputError, match="in use by another"):
        DataFolder(folder.root).open()
    folder.close()
    DataFolder(folder.root).open()


def test_ids_are_opaque_safe_in_urls_and_never_the_same() -> None:
    ids = {new_id() for _ in range(1000)}
    assert len(ids) == 1000
    assert all(len(one) == 16 and one.isalnum() for one in ids)
