"""The command line: `echorooms COMMAND`."""

from __future__ import annotations

import sys
from importlib.metadata import PackageNotFoundError, version
from typing import Annotated

import typer

from app.commands.bridge import bridge
from app.commands.demo import demo
from app.commands.localize import localize
from app.commands.map import map_log
from app.commands.model import model
from app.commands.reproduce import reproduce
from app.commands.rosbridge import rosbridge
from app.commands.serve import serve
from app.commands.simulate import simulate
from app.commands.stream import stream
from app.commands.token import token
from core.errors import CancelledError, EchoRoomsError, InputError

BAD_USAGE, FAILED, INTERRUPTED = 2, 1, 130

_CommandLineError: type[Exception] = typer.BadParameter.__mro__[2]
"""ClickException: base of all usage errors, wherever this version of typer keeps it."""

app = typer.Typer(
    name="echorooms",
    help="Grid maps, named rooms and an honest 'where am I?' from cheap sonar.",
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


def _show_version(wanted: bool) -> None:
    if wanted:
        try:
            typer.echo(f"echorooms {version('echorooms')}")
        except PackageNotFoundError:
            typer.echo("echorooms (not installed)")
        raise typer.Exit


@app.callback()
def options(
    show_version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version."),
    ] = False,
) -> None:
    """Grid maps, named rooms and an honest 'where am I?' from cheap sonar."""


app.command("demo")(demo)
app.command("serve")(serve)
app.command("simulate")(simulate)
app.command("map")(map_log)
app.command("model")(model)
app.command("localize")(localize)
app.command("stream")(stream)
app.command("bridge")(bridge)
app.command("rosbridge")(rosbridge)
app.command("token")(token)
app.command("reproduce")(reproduce)


def main(arguments: list[str] | None = None) -> None:
    """Runs a command and ends the process: 0, or one line on stderr and non-zero."""
    sys.exit(run(arguments))


def run(arguments: list[str] | None = None) -> int:
    """Runs a command and returns its exit status."""
    given = sys.argv[1:] if arguments is None else arguments
    try:
        status = typer.main.get_command(app)(given or ["--help"], standalone_mode=False)
    except typer.Exit as error:
        return error.exit_code
    except InputError as error:
        return _fail(str(error), BAD_USAGE)
    except (typer.Abort, KeyboardInterrupt, CancelledError):
        return _fail("interrupted", INTERRUPTED)
    except EchoRoomsError as error:
        return _fail(str(error), FAILED)
    except OSError as error:
        return _fail(f"{error.filename or 'file'}: {error.strerror or error}", FAILED)
    except MemoryError:
        return _fail("not enough memory for this input", FAILED)
    except _CommandLineError as error:
        return _fail(error.format_message(), BAD_USAGE)  # type: ignore[attr-defined]
    return int(status or 0)


def _fail(message: str, status: int) -> int:
    line = " ".join(message.split())
    sys.stderr.write(f"error: {line}\n")
    return status
