"""`echorooms token`: new tokens for a server that is reached from other machines."""

from __future__ import annotations

import typer

from app.commands.serve import DataOption, settings_of


def token(data: DataOption = None) -> None:
    """Make new tokens for writing and for reading; those before end with the next start."""
    from app.access import renew_tokens

    tokens = renew_tokens(settings_of(None, None, data).data)
    typer.echo(f"writing: {tokens.write}\nreading: {tokens.read}")
    typer.echo("They are shown this once. Start the server again to use them.", err=True)
