"""The page of the 3D view: viser's own, from its wheel, with its panels hidden and its headers set."""

from __future__ import annotations

import gzip
import hashlib
from dataclasses import dataclass
from functools import cache
from importlib import resources

from fastapi import Request
from fastapi.responses import Response

CONTENT_POLICY = (
    "default-src 'none'; script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval' blob:; "
    "worker-src blob:; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "font-src data:; connect-src 'self' data: blob:; frame-ancestors 'self'"
)
_COMPRESSION = 6


@dataclass(frozen=True)
class ViewPage:
    """The page's bytes, plain and compressed, and a name for exactly these."""

    plain: bytes
    compressed: bytes
    etag: str

    def response(self, request: Request) -> Response:
        """The page, or 304 when the browser has it."""
        headers = {
            "etag": self.etag,
            "cache-control": "no-cache",
            "content-security-policy": CONTENT_POLICY,
            "vary": "accept-encoding",
        }
        if request.headers.get("if-none-match") == self.etag:
            return Response(status_code=304, headers=headers)
        if "gzip" in request.headers.get("accept-encoding", ""):
            headers["content-encoding"] = "gzip"
            return Response(self.compressed, headers=headers, media_type="text/html")
        return Response(self.plain, headers=headers, media_type="text/html")


@cache
def view_page() -> ViewPage:
    """The page, made once per process."""
    html = resources.files("viser").joinpath("client/build/index.html").read_text("utf-8")
    here = resources.files("app.viewer") / "page"
    style = (here / "view.css").read_text("utf-8")
    script = (here / "view.js").read_text("utf-8")
    head = html.index("<head>") + len("<head>")
    inserted = f"<style>{style}</style><script>{script}</script>"
    plain = (html[:head] + inserted + html[head:]).encode()
    return ViewPage(
        plain, gzip.compress(plain, _COMPRESSION, mtime=0), f'"{hashlib.sha256(plain).hexdigest()}"'
    )
