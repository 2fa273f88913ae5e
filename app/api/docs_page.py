"""The API's documentation at `/docs`: a page of ours, because FastAPI's own loads from the internet."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import FileResponse

from app.api.static_pages import STATIC_FOLDER

router = APIRouter(include_in_schema=False)


@router.get("/docs")
def docs_page() -> FileResponse:
    """The page; it reads openapi.json."""
    return FileResponse(STATIC_FOLDER / "docs" / "api" / "index.html")
