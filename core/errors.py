"""The errors that a person can act on. Everything else that is raised is a bug of ours."""

from __future__ import annotations


class EchoRoomsError(Exception):
    """Base of all expected errors; the message is one line, written for the user."""


class InputError(EchoRoomsError):
    """Something that was given is wrong: a file, an option, a request (exit status 2, HTTP 422)."""


class UsageError(InputError):
    """A combination of options that cannot be (autonomous modelling with a number of regions, say)."""


class LogError(InputError):
    """A robot log that cannot be read.

    Args:
        message: what is wrong and what to do.
        source: the file as the user knows it.
        line: 1-based line of the file, where there is one.
    """

    def __init__(self, message: str, source: str | None = None, line: int | None = None) -> None:
        self.source = source
        self.line = line
        place = ", ".join(
            part for part in (source, f"line {line}" if line is not None else None) if part
        )
        super().__init__(f"{place}: {message}" if place else message)


class TooLargeError(InputError):
    """An input beyond a documented limit (exit status 2, HTTP 413)."""


class MapError(InputError):
    """A map (map.yaml and its image) that cannot be read or cannot be modelled."""


class ModelError(InputError):
    """A model folder that cannot be read, or an edit that it does not allow."""


class CancelledError(EchoRoomsError):
    """Long work was stopped because somebody asked for it."""
