from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from core.errors import ModelError
from core.topology.timeline_file import read_step, read_timeline, write_timeline

PICTURES = (b"first", b"second", b"third")


def test_the_pictures_of_all_steps_read_back(tmp_path: Path) -> None:
    path = tmp_path / "timeline.zip"
    write_timeline(PICTURES, path)
    assert read_timeline(path) == PICTURES
    assert read_step(path, 1) == b"second"


def test_a_model_of_an_older_version_has_no_timeline(tmp_path: Path) -> None:
    assert read_timeline(tmp_path / "timeline.zip") == ()
    with pytest.raises(ModelError, match="no timeline"):
        read_step(tmp_path / "timeline.zip", 0)


def test_a_step_that_is_missing_is_said(tmp_path: Path) -> None:
    path = tmp_path / "timeline.zip"
    write_timeline(PICTURES, path)
    with pytest.raises(ModelError, match="no step 3"):
        read_step(path, 3)


def test_a_broken_archive_is_said(tmp_path: Path) -> None:
    path = tmp_path / "timeline.zip"
    path.write_bytes(b"PK nothing")
    with pytest.raises(ModelError, match=r"timeline\.zip cannot be read"):
        read_timeline(path)


def test_a_compressed_member_is_refused_before_it_is_unpacked(tmp_path: Path) -> None:
    path = tmp_path / "timeline.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("0000.png", b"\0" * 10_000_000)
    with pytest.raises(ModelError, match="is compressed"):
        read_timeline(path)
