"""The product's settings: the only place that looks at the environment (`ECHOROOMS_*`)."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import platformdirs
from pydantic import AfterValidator, BeforeValidator, Field
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

MEBIBYTE = 1 << 20
LOOPBACK_HOSTS = ("127.0.0.1", "localhost", "::1")
PACKAGE_ROOT = Path(__file__).resolve().parents[1]
"""The folder that holds `app`, `core`, `static` and `sample_logs`: the repository or site-packages."""


def _default_data() -> Path:
    return Path(platformdirs.user_data_dir("echorooms", appauthor=False))


def _names(given: object) -> object:
    """Names with commas between them, as an environment variable gives them, one by one."""
    if isinstance(given, str):
        return tuple(name.strip().lower() for name in given.split(",") if name.strip())
    return given


def _whole_path(path: Path) -> Path:
    """The path as it is meant wherever a worker is started."""
    return path.expanduser().absolute()


Names = Annotated[tuple[str, ...], NoDecode, BeforeValidator(_names)]


class Settings(BaseSettings):
    """What a server is told. Every field can be set as `ECHOROOMS_NAME` in the environment."""

    model_config = SettingsConfigDict(env_prefix="ECHOROOMS_", frozen=True, extra="ignore")

    host: str = Field("127.0.0.1", description="address to listen on")
    port: int = Field(8000, ge=0, le=65535, description="port to listen on; 0 = any free one")
    data: Annotated[Path, AfterValidator(_whole_path)] = Field(
        default_factory=_default_data, description="folder that keeps everything"
    )
    allowed_hosts: Names = Field(
        (), description="further host names under which the server may be reached, with commas"
    )
    allowed_origins: Names = Field(
        (),
        description="origins of other pages that may use the API (https://example.org), with commas",
    )
    mqtt_url: str = Field(
        "", description="MQTT broker (mqtt://user:password@host:1883); empty: none"
    )
    mqtt_topic: Annotated[str, Field(pattern=r"^[A-Za-z0-9_/-]+$")] = Field(
        "echorooms", description="MQTT topic below which robots have theirs"
    )
    home_assistant: bool = Field(
        False, description="announce current rooms to Home Assistant (MQTT discovery)"
    )
    demo: bool = Field(False, description="load and model the sample logs at start")

    max_upload_mb: int = Field(256, ge=1, description="largest upload in MiB")
    upload_timeout_s: float = Field(60, gt=0, description="longest time to read an upload")
    upload_memory_mb: int = Field(768, ge=64, description="memory to read an upload with")
    max_jobs: int = Field(
        default_factory=lambda: os.cpu_count() or 1, ge=1, description="jobs at the same time"
    )
    job_timeout_s: float = Field(1800, gt=0, description="longest time of a job")
    job_memory_mb: int = Field(4096, ge=64, description="memory that a job may take")
    warm_workers: int = Field(1, ge=0, description="idle worker processes kept ready")
    heartbeat_s: float = Field(15, gt=0, description="silence after which an event stream says so")

    @property
    def max_upload_bytes(self) -> int:
        """Largest upload in bytes."""
        return self.max_upload_mb * MEBIBYTE

    @property
    def loopback_only(self) -> bool:
        """True while nobody outside this machine can connect."""
        return self.host in LOOPBACK_HOSTS or self.host.startswith("127.")


def worker_environment() -> dict[str, str]:
    """The environment of a worker process.

    Jobs run side by side, so each keeps to one thread in the linear algebra; the path makes sure
    that the worker runs this very installation, whatever the folder it is started from.
    """
    inherited = os.environ.get("PYTHONPATH")
    path = os.pathsep.join(part for part in (str(PACKAGE_ROOT), inherited) if part)
    one_thread = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
    return os.environ | one_thread | {"PYTHONPATH": path, "PYTHONUNBUFFERED": "1"}
