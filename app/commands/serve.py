"""`echorooms serve`: the dashboard and the API."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from app.settings import Settings

HostOption = Annotated[str | None, typer.Option(help="Address to listen on [127.0.0.1].")]
PortOption = Annotated[
    int | None, typer.Option(min=0, max=65535, help="Port; 0 takes any free one [8000].")
]
DataOption = Annotated[Path | None, typer.Option(help="Folder that keeps logs and models.")]


def serve(host: HostOption = None, port: PortOption = None, data: DataOption = None) -> None:
    """Serve the dashboard and the API until Ctrl-C."""
    serve_with(settings_of(host, port, data))


def settings_of(host: str | None, port: int | None, data: Path | None, **more: Any) -> Settings:
    """Settings from the environment, overridden by what the command line gives.

    Raises:
        InputError: a value cannot be.
    """
    from pydantic import ValidationError

    from app.settings import Settings
    from core.errors import InputError
    from core.log_readers.safe_yaml import describe

    given = {"host": host, "port": port, "data": data, **more}
    try:
        return Settings(**{name: value for name, value in given.items() if value is not None})
    except ValidationError as error:
        raise InputError(f"setting {describe(error)}") from error


def serve_with(settings: Settings) -> None:
    """Runs the server and says where it is."""
    from app.serve import run

    def say(url: str) -> None:
        typer.echo(f"EchoRooms is at {url}  (Ctrl-C stops it)")
        if not settings.loopback_only:
            typer.echo("Anyone who can reach this address can see and change everything.", err=True)

    run(settings, say)
