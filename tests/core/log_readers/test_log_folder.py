"""Zips with a log.yaml, good and hostile."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from core.errors import LogError, TooLargeError
from core.log_readers import read_log

DESCRIPTION = """
ring: circle-8
files:
  - path: drive.txt
    columns: {t: 0, x: 1, y: 2, heading: 3, ranges: [4, 5, 6, 7, 8, 9, 10, 11]}
"""
ROW = "%d 0 0 0 1 1 1 1 1 1 1 1\n"
DRIVE = "".join(ROW % i for i in range(5))
MakeZip = Callable[..., Path]


@pytest.fixture
def make_zip(tmp_path: Path) -> MakeZip:
    def make(files: dict[str, str | bytes], compression: int = zipfile.ZIP_DEFLATED) -> Path:
        path = tmp_path / "log.zip"
        with zipfile.ZipFile(path, "w", compression) as archive:
            for name, content in files.items():
                archive.writestr(name, content)
        return path

    return make


@pytest.mark.parametrize("folder", ["", "my drive/"])
def test_a_zip_is_read_with_or_without_a_folder_in_it(folder: str, make_zip: MakeZip) -> None:
    path = make_zip({folder + "log.yaml": DESCRIPTION, folder + "drive.txt": DRIVE, "notes": "x"})
    loaded = read_log(path)
    assert len(loaded.log) == 5
    assert loaded.log.name == "log"


@pytest.mark.parametrize("name", ["../drive.txt", "/etc/passwd", "a/../../b", "C:\\x", "."])
def test_a_path_that_leads_out_of_the_log_is_refused(
    name: str, make_zip: MakeZip, tmp_path: Path
) -> None:
    description = DESCRIPTION.replace("drive.txt", f"'{name}'")
    with pytest.raises(LogError, match="is not inside the log's folder"):
        read_log(make_zip({"log.yaml": description, name: DRIVE}))
    (tmp_path / "log.yaml").write_text(description, encoding="utf-8")
    with pytest.raises(LogError, match="is not inside the log's folder"):
        read_log(tmp_path / "log.yaml")


def test_a_link_in_a_zip_is_refused(make_zip: MakeZip) -> None:
    path = make_zip({"log.yaml": DESCRIPTION})
    link = zipfile.ZipInfo("drive.txt")
    link.external_attr = 0o120777 << 16
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(link, "/etc/passwd")
    with pytest.raises(LogError, match=r"log.zip/drive.txt: is a link"):
        read_log(path)


def test_a_rare_packing_is_refused(make_zip: MakeZip) -> None:
    path = make_zip({"log.yaml": DESCRIPTION, "drive.txt": DRIVE}, zipfile.ZIP_BZIP2)
    with pytest.raises(LogError, match="make the zip with plain deflate"):
        read_log(path)


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ({"drive.txt": DRIVE}, "the zip has no log.yaml"),
        ({"a/b/log.yaml": DESCRIPTION}, "the zip has no log.yaml"),
        ({"log.yaml": DESCRIPTION}, "there is no file 'drive.txt' in the zip"),
        ({"log.yaml": DESCRIPTION, "drive.txt": ""}, r"log.zip/drive.txt: there are no rows"),
        ({"log.yaml": DESCRIPTION, "drive.txt": DRIVE + "1 2\n"}, r"drive.txt, line 6: 2 columns"),
    ],
)
def test_what_is_missing_in_a_zip_is_named(
    files: dict[str, str], message: str, make_zip: MakeZip
) -> None:
    with pytest.raises(LogError, match=message):
        read_log(make_zip(files))


def test_a_zip_bomb_is_refused_while_it_unpacks(make_zip: MakeZip) -> None:
    path = make_zip({"log.yaml": DESCRIPTION, "drive.txt": (" " * 2**16 + "\n") * 500})
    with pytest.raises(TooLargeError, match="unpacks to more than 16 MB"):
        read_log(path)


def test_a_zip_of_very_many_files_is_refused(make_zip: MakeZip) -> None:
    files = {"log.yaml": DESCRIPTION, "drive.txt": DRIVE}
    with pytest.raises(TooLargeError, match="more than 1000 files"):
        read_log(make_zip(files | {f"{i}": "" for i in range(1000)}))
    with pytest.raises(TooLargeError, match="too many files"):
        read_log(make_zip(files | {f"{i}" + "x" * 900: "" for i in range(1200)}))


def test_a_zip_with_a_wrong_byte_anywhere_is_an_error_or_a_log(make_zip: MakeZip) -> None:
    path = make_zip({"log.yaml": DESCRIPTION, "drive.txt": DRIVE})
    content = path.read_bytes()
    for place in range(0, len(content), 3):
        spoiled = bytearray(content)
        spoiled[place] ^= 0xA5
        path.write_bytes(spoiled)
        try:
            message = read_log(path).report.verdict[0]
        except (LogError, TooLargeError) as error:
            message = str(error)
        assert "\n" not in message
        assert message.startswith(("log.zip", "Not good"))


def test_a_zip_cut_anywhere_is_an_error(make_zip: MakeZip) -> None:
    path = make_zip({"log.yaml": DESCRIPTION, "drive.txt": DRIVE})
    content = path.read_bytes()
    for length in range(1, len(content), 29):
        path.write_bytes(io.BytesIO(content).read(length))
        with pytest.raises(LogError):
            read_log(path)
