"""Who may talk to the server from a browser: Host and Origin checks, and the headers of every answer.

Without the Host check a hostile page could reach a server on loopback through a name that it makes
point there (DNS rebinding); without the Origin check it could send forms and open WebSockets.
"""

from __future__ import annotations

import ipaddress
from collections.abc import Mapping
from http import HTTPStatus
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.errors import problem_response
from app.settings import LOOPBACK_HOSTS, Settings

SAFE_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})
FOREIGN_SITES = frozenset({"cross-site", "same-site"})
PAGE_POLICY = (
    "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; object-src 'none'; base-uri 'none'; form-action 'self'; "
    "frame-ancestors 'self'"
)
HEADERS = {
    "content-security-policy": PAGE_POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "same-origin",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}
"""Set where a route has not chosen its own (the 3D view has another content policy)."""
NEVER_KEPT = {"cache-control": "no-store"}
API_PREFIX = "/api/"


def host_allowed(headers: Mapping[str, str], settings: Settings) -> bool:
    """Whether the Host header names this server.

    Loopback names and configured names always do. When the server listens beyond loopback, plain
    addresses do too: a page cannot make the browser believe that an address is its own name.
    """
    name = _hostname(headers.get("host", ""))
    if name is None:
        return False
    if name in LOOPBACK_HOSTS or name in settings.allowed_hosts or name == settings.host:
        return True
    address = _address(name)
    if address is None:
        return False
    return address.is_loopback or not settings.loopback_only


def origin_allowed(headers: Mapping[str, str], settings: Settings) -> bool:
    """Whether a request that changes something, or a WebSocket, may come from where it says.

    Programs send no Origin and are let in; a browser's page must be of this server (Origin and Host
    agree) or of a configured origin.
    """
    origin = headers.get("origin")
    if origin is None:
        return headers.get("sec-fetch-site", "none") not in FOREIGN_SITES
    if origin in settings.allowed_origins:
        return True
    return urlsplit(origin).netloc.lower() == headers.get("host", "").lower() != ""


class BrowserGuard:
    """ASGI middleware: refuses foreign hosts and origins, and adds the security headers."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        self.app = app
        self.settings = settings

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serves one connection."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if refusal is None:
            await self.app(scope, receive, _with_headers(send, scope))
        elif scope["type"] == "http":
            response = problem_response(HTTPStatus.FORBIDDEN, refusal)
            await response(scope, receive, _with_headers(send, scope))
        else:
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": refusal})

    def _refusal(self, scope: Scope) -> str | None:
        headers = Headers(scope=scope)
        if not host_allowed(headers, self.settings):
            return (
                f"this server does not answer to the name {headers.get('host', '')[:80]!r}; "
                "if it should, set ECHOROOMS_ALLOWED_HOSTS to that name"
            )
        safe = scope["type"] == "http" and scope["method"] in SAFE_METHODS
        if not safe and not origin_allowed(headers, self.settings):
            return "a page of another origin may not do this"
        return None


def _with_headers(send: Send, scope: Scope) -> Send:
    wanted = HEADERS | (NEVER_KEPT if scope["path"].startswith(API_PREFIX) else {})

    async def send_with_headers(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in wanted.items():
                headers.setdefault(name, value)
        await send(message)

    return send_with_headers


def _hostname(host: str) -> str | None:
    """The name in a Host header, without port and brackets; None if it is none."""
    try:
        return urlsplit(f"//{host}").hostname
    except ValueError:
        return None


def _address(name: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    try:
        return ipaddress.ip_address(name)
    except ValueError:
        return None
