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
    from app.access import open_access
    from app.serve import run

    access, fresh = (None, None) if settings.loopback_only else open_access(settings.data)

    def say(url: str) -> None:
        typer.echo(f"EchoRooms is at {url}  (Ctrl-C stops it)")
        if fresh is not None:
            typer.echo(f"token for writing: {fresh.write}\ntoken for reading: {fresh.read}")
            typer.echo("They are shown this once; `echorooms token` makes new ones.", err=True)
        elif access is not None:
            typer.echo("It asks for its token; `echorooms token` makes a new one.", err=True)

    run(settings, say, access)
