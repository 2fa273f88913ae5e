"""Settings from the environment."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import ValidationError

from app.settings import PACKAGE_ROOT, Settings, worker_environment


def test_the_environment_sets_what_the_command_line_does_not(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("ECHOROOMS_PORT", "9001")
    monkeypatch.setenv("ECHOROOMS_DATA", str(tmp_path))
    monkeypatch.setenv("ECHOROOMS_ALLOWED_HOSTS", "robots.example, Pi.local")
    settings = Settings(host="0.0.0.0")
    assert (settings.port, settings.data) == (9001, tmp_path)
    assert settings.allowed_hosts == ("robots.example", "pi.local")
    assert not settings.loopback_only


def test_by_default_it_listens_on_loopback_only() -> None:
    settings = Settings()
    assert settings.loopback_only
    assert settings.port == 8000


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1", "127.1.2.3"])
def test_loopback_addresses_are_known(host: str) -> None:
    assert Settings(host=host).loopback_only


def test_the_data_folder_is_a_whole_path(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    assert Settings(data=Path("~/robots")).data == tmp_path / "robots"
    assert Settings(data=Path("robots")).data == tmp_path / "robots"
    assert Settings().data.is_absolute()


def test_settings_that_cannot_be_are_refused() -> None:
    with pytest.raises(ValidationError):
        Settings(port=70_000)
    with pytest.raises(ValidationError):
        Settings(max_jobs=0)


def test_a_worker_finds_this_installation_wherever_the_server_was_started(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("PYTHONPATH", "/elsewhere")
    environment = worker_environment()
    assert environment["PYTHONPATH"].split(":")[0] == str(PACKAGE_ROOT)
    assert environment["PYTHONPATH"].endswith("/elsewhere")
    assert environment["OPENBLAS_NUM_THREADS"] == "1"
