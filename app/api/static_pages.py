"""The dashboard's files at `/`, and the answer to every address that nobody serves."""

from __future__ import annotations

from pathlib import Path

from fastapi import FastAPI
from starlette.exceptions import HTTPException
from starlette.responses import Response
from starlette.routing import Match
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from app.settings import PACKAGE_ROOT

STATIC_FOLDER = PACKAGE_ROOT / "static"
API_PREFIX = "api"


class StaticPages(StaticFiles):
    """Static files that are asked for again each time, and tell a wrong method from a wrong path."""

    def __init__(self, app: FastAPI, directory: Path) -> None:
        super().__init__(directory=directory, html=True, check_dir=False)
        self._app = app

    async def get_response(self, path: str, scope: Scope) -> Response:
        """A file, or 404 / 405."""
        if Path(path).parts[:1] == (API_PREFIX,):
            raise HTTPException(405 if self._known_path(scope) else 404)
        response = await super().get_response(path, scope)
        response.headers["cache-control"] = "no-cache"
        return response

    def _known_path(self, scope: Scope) -> bool:
        outer = {**scope, "path": scope["path"], "root_path": ""}
        return any(route.matches(outer)[0] is Match.PARTIAL for route in self._app.router.routes)
