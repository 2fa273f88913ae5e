"""How long the body of a request may be."""

from __future__ import annotations

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import TooLarge
from app.settings import MEBIBYTE

MAX_BODY_BYTES = 8 * MEBIBYTE
"""Of everything that is no upload; ten minutes of scans at 4 Hz are 1 MB."""


class BodyLimit:
    """ASGI middleware: a body longer than the limit is answered with 413, and not kept in memory.

    Forms are let through: their reader has a limit of its own and streams them to disk.
    """

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serves one connection."""
        is_form = scope["type"] == "http" and Headers(scope=scope).get(
            "content-type", ""
        ).startswith("multipart/form-data")
        limited = scope["type"] == "http" and not is_form
        await self.app(scope, _limited(receive) if limited else receive, send)


def _limited(receive: Receive) -> Receive:
    received = 0

    async def receive_within_limit() -> Message:
        nonlocal received
        message = await receive()
        received += len(message.get("body", b""))
        if received > MAX_BODY_BYTES:
            raise TooLarge(f"the body may have at most {MAX_BODY_BYTES // MEBIBYTE} MB")
        return message

    return receive_within_limit
