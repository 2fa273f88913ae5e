"""Every error of the API as `application/problem+json` (RFC 9457); `detail` is the one line to show."""

from __future__ import annotations

import errno
import logging
from collections.abc import Mapping
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, Response
from starlette.exceptions import HTTPException

from core.errors import EchoRoomsError, InputError, LogError, TooLargeError

logger = logging.getLogger(__name__)
PROBLEM_JSON = "application/problem+json"
PROBLEM_RESPONSES: dict[int | str, dict[str, Any]] = {
    "4XX": {
        "description": "what is wrong, as a problem document (RFC 9457)",
        "content": {
            PROBLEM_JSON: {
                "schema": {
                    "type": "object",
                    "required": ["type", "title", "status", "detail"],
                    "properties": {
                        "type": {"type": "string"},
                        "title": {"type": "string"},
                        "status": {"type": "integer"},
                        "detail": {"type": "string", "description": "one line for a person"},
                        "line": {"type": "integer", "description": "of the log that is wrong"},
                        "errors": {"type": "array", "description": "fields that are wrong"},
                    },
                }
            }
        },
    }
}
"""How OpenAPI describes the errors of every endpoint."""


class Problem(HTTPException):
    """A request that cannot be served, with further members for the problem document."""

    def __init__(self, status: HTTPStatus, detail: str, **members: Any) -> None:
        super().__init__(status.value, detail)
        self.members = members


class NotFound(Problem):
    """There is no such log, model, node or job."""

    def __init__(self, kind: str, identifier: str) -> None:
        super().__init__(
            HTTPStatus.NOT_FOUND, f"there is no {kind} with the id {identifier[:80]!r}"
        )


class Conflict(Problem):
    """The request does not fit the present state."""

    def __init__(self, detail: str, **members: Any) -> None:
        super().__init__(HTTPStatus.CONFLICT, detail, **members)


class Unprocessable(Problem):
    """The request is well-formed, but what it asks cannot be."""

    def __init__(self, detail: str, **members: Any) -> None:
        super().__init__(HTTPStatus.UNPROCESSABLE_ENTITY, detail, **members)


class TooLarge(Problem):
    """The body of the request is beyond the limit."""

    def __init__(self, detail: str) -> None:
        super().__init__(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, detail)


def problem_response(
    status: int,
    detail: str,
    headers: Mapping[str, str] | None = None,
    **members: Any,
) -> Response:
    """A problem document as a response."""
    body = {
        "type": "about:blank",
        "title": _title(status),
        "status": status,
        "detail": detail,
    }
    return JSONResponse(body | members, status, headers, media_type=PROBLEM_JSON)


def install_error_handlers(app: FastAPI) -> None:
    """Makes every error of the app a problem document."""
    app.add_exception_handler(HTTPException, _http_error)
    app.add_exception_handler(RequestValidationError, _validation_error)
    app.add_exception_handler(EchoRoomsError, _expected_error)
    app.add_exception_handler(OSError, _system_error)
    app.add_exception_handler(Exception, _unexpected_error)


async def _http_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    members = error.members if isinstance(error, Problem) else {}
    return problem_response(error.status_code, str(error.detail), error.headers, **members)


async def _validation_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, RequestValidationError)
    errors = [
        {
            "field": ".".join(str(part) for part in item["loc"][1:]),
            "message": item["msg"].removeprefix("Value error, "),
        }
        for item in error.errors()
    ]
    detail = "; ".join(
        f"{item['field']}: {item['message']}" if item["field"] else item["message"]
        for item in errors
    )
    return problem_response(HTTPStatus.UNPROCESSABLE_ENTITY, detail[:500], errors=errors)


async def _expected_error(request: Request, error: Exception) -> Response:
    if isinstance(error, TooLargeError):
        return problem_response(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, str(error))
    if isinstance(error, LogError) and error.line is not None:
        return problem_response(HTTPStatus.UNPROCESSABLE_ENTITY, str(error), line=error.line)
    if isinstance(error, InputError):
        return problem_response(HTTPStatus.UNPROCESSABLE_ENTITY, str(error))
    return await _unexpected_error(request, error)


async def _system_error(request: Request, error: Exception) -> Response:
    if isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT):
        detail = "the disk is full: delete logs or models, or give the server another data folder"
        return problem_response(HTTPStatus.INSUFFICIENT_STORAGE, detail)
    return await _unexpected_error(request, error)


async def _unexpected_error(request: Request, error: Exception) -> Response:
    logger.error("%s %s failed", request.method, request.url.path, exc_info=error)
    detail = "something went wrong in the server; its own log says more"
    return problem_response(HTTPStatus.INTERNAL_SERVER_ERROR, detail)


def _title(status: int) -> str:
    try:
        return HTTPStatus(status).phrase
    except ValueError:
        return "Error"
