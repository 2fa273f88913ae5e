"""Starting the server."""

from __future__ import annotations

import socket
from pathlib import Path

import pytest

from app.serve import run
from app.settings import Settings
from core.errors import InputError


def test_a_taken_port_is_told_in_one_line_and_the_data_folder_is_not_touched(
    tmp_path: Path,
) -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(InputError, match=rf"port {port} is taken .* --port"):
            run(Settings(port=port, data=tmp_path / "data"))
    assert list(tmp_path.iterdir()) == []


def test_an_address_of_another_machine_is_told_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"cannot listen on 192\.0\.2\.1"):
        run(Settings(host="192.0.2.1", port=0, data=tmp_path / "data"))


def test_a_data_folder_that_cannot_be_is_told_in_one_line(tmp_path: Path) -> None:
    occupied = tmp_path / "file"
    occupied.write_text("not a folder")
    with pytest.raises(InputError, match="--data"):
        run(Settings(port=0, data=occupied))
