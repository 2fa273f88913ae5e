"""YAML from strangers: small, without aliases (no "billion laughs"), without tags that make objects."""

from __future__ import annotations

from typing import Any

import yaml
from pydantic import ValidationError

from core.errors import LogError, TooLargeError
from core.log_readers.limits import ReadLimits


class _PlainLoader(yaml.SafeLoader):
    """The safe loader without aliases."""

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        if self.check_event(yaml.AliasEvent):
            mark = self.peek_event().start_mark  # type: ignore[no-untyped-call]
            raise yaml.MarkedYAMLError(problem="aliases (*name) are not allowed", problem_mark=mark)
        return super().compose_node(parent, index)


def load_yaml(data: bytes, source: str, limits: ReadLimits) -> Any:
    """What a small YAML (or JSON) text says.

    Raises:
        LogError: it is no YAML; with the line where that is known.
        TooLargeError: it is longer than a description of a log can be.
    """
    if len(data) > limits.max_yaml_bytes:
        raise TooLargeError(f"{source}: longer than {limits.max_yaml_bytes // 1024} kB")
    try:
        return yaml.load(data.decode("utf-8-sig"), Loader=_PlainLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark else None
        raise LogError(f"no valid YAML ({error.problem or error.context})", source, line) from error
    except RecursionError as error:
        raise LogError("no valid YAML (nested too deep)", source) from error
    except (yaml.YAMLError, ValueError, TypeError, KeyError, AttributeError) as error:
        reason = " ".join(str(error).split())[:100]
        raise LogError(f"no valid YAML ({reason})", source) from error


def describe(error: ValidationError) -> str:
    """The first thing that is wrong, as `files[0].columns.t: Field required`."""
    first = error.errors(include_url=False, include_input=False)[0]
    place = ""
    for part in first["loc"]:
        place += f"[{part}]" if isinstance(part, int) else f".{part}" if place else str(part)
    message = first["msg"].removeprefix("Value error, ")
    return f"{place}: {message}" if place else message
