"""Asks for a token at every door of a server that is reached from other machines.

A program sends `Authorization: Bearer TOKEN`; a person gives the token to the login page once and
gets a cookie that scripts cannot read. Reading needs either token, everything else the writing one.
"""

from __future__ import annotations

from http import HTTPStatus
from urllib.parse import parse_qs

from starlette.datastructures import Headers
from starlette.requests import Request, cookie_parser
from starlette.responses import HTMLResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from app.access import Access, Right
from app.errors import problem_response
from app.security import SAFE_METHODS

LOGIN, LOGOUT = "/login", "/logout"
OPEN_PATHS = frozenset({LOGIN, LOGOUT, "/api/health", "/logo.svg", "/css/base.css"})
SHOWING = ("/view/", "/events")
"""Beginning or end of the paths of WebSockets that only show; any other may change something."""
COOKIE = "echorooms_token"
COOKIE_S = 30 * 24 * 3600
LARGEST_FORM = 4096
PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>EchoRooms: login</title><link rel="icon" href="logo.svg"><link rel="stylesheet" href="css/base.css">
<style>
form {{ max-width: 360px; margin: 18vh auto; display: grid; gap: 12px; padding: 0 20px; }}
input, button {{ font: inherit; padding: 10px 12px; }} [role=alert] {{ color: #c62828; }}
</style></head><body><form method="post" action="login">
<h1>EchoRooms</h1>
<label for="token">This server asks for a token. It was shown when the server was first started;
<code>echorooms token</code> makes a new one.</label>
<input id="token" name="token" type="password" autocomplete="current-password" required autofocus>
<p role="alert">{error}</p><button>Log in</button></form></body></html>
"""


class TokenGuard:
    """ASGI middleware; without an access (on loopback) it lets everybody through."""

    def __init__(self, app: ASGIApp, access: Access | None) -> None:
        self.app = app
        self._access = access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serves one connection."""
        if self._access is None or scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
        elif scope["type"] == "websocket":
            await self._socket(scope, receive, send, self._access)
        elif scope["path"] in (LOGIN, LOGOUT):
            response = await _login_or_out(Request(scope, receive), self._access)
            await response(scope, receive, send)
        else:
            refusal = _refusal(scope, self._access)
            await (refusal or self.app)(scope, receive, send)

    async def _socket(self, scope: Scope, receive: Receive, send: Send, access: Access) -> None:
        path: str = scope["path"]
        shows = path.startswith(SHOWING[0]) or path.endswith(SHOWING[1])
        wanted = Right.READ if shows else Right.WRITE
        if access.right_of(token_of(Headers(scope=scope))) >= wanted:
            await self.app(scope, receive, send)
            return
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": "a token is needed"})


def token_of(headers: Headers) -> str | None:
    """The token that a request brings, in its header or its cookie."""
    scheme, _, given = headers.get("authorization", "").partition(" ")
    if scheme.lower() == "bearer":
        return given.strip()
    return cookie_parser(headers.get("cookie", "")).get(COOKIE)


def _refusal(scope: Scope, access: Access) -> Response | None:
    """What a request is answered that its token does not allow."""
    headers, path = Headers(scope=scope), scope["path"]
    right = access.right_of(token_of(headers))
    reads = scope["method"] in SAFE_METHODS
    if path in OPEN_PATHS or right >= (Right.READ if reads else Right.WRITE):
        return None
    if right is Right.READ:
        return problem_response(
            HTTPStatus.FORBIDDEN, "this token only reads; log in with the one for writing"
        )
    if reads and "text/html" in headers.get("accept", ""):
        return RedirectResponse(LOGIN, HTTPStatus.SEE_OTHER)
    return problem_response(
        HTTPStatus.UNAUTHORIZED,
        "this server asks for a token: send Authorization: Bearer TOKEN, or log in at /login",
        {"www-authenticate": "Bearer"},
    )


async def _login_or_out(request: Request, access: Access) -> Response:
    if request.url.path == LOGOUT:
        response: Response = RedirectResponse(LOGIN, HTTPStatus.SEE_OTHER)
        response.delete_cookie(COOKIE)
        return response
    if request.method != "POST":
        return HTMLResponse(PAGE.format(error=""))
    token = await _given_token(request)
    if access.right_of(token) is Right.NOTHING:
        page = PAGE.format(error="That is none of this server's tokens.")
        return HTMLResponse(page, HTTPStatus.UNAUTHORIZED)
    response = RedirectResponse("/", HTTPStatus.SEE_OTHER)
    secure = request.url.scheme == "https"
    response.set_cookie(
        COOKIE, token, COOKIE_S, httponly=True, samesite="strict", secure=secure, path="/"
    )
    return response


async def _given_token(request: Request) -> str:
    """The field of the login form; "" where there is none."""
    body = b""
    async for part in request.stream():
        body += part
        if len(body) > LARGEST_FORM:
            return ""
    fields = parse_qs(body.decode("utf-8", "replace"))
    return fields.get("token", [""])[0].strip()
