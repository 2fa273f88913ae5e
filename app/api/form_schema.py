"""How OpenAPI describes the forms that `upload_form` reads."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Part = dict[str, Any]


def file_part(description: str) -> Part:
    """A file of a form."""
    return {
        "type": "string",
        "contentMediaType": "application/octet-stream",
        "description": description,
    }


def text_part(description: str) -> Part:
    """A text field of a form."""
    return {"type": "string", "description": description}


def form_body(required: Sequence[str], **parts: Part) -> dict[str, Any]:
    """A multipart request body with these parts."""
    schema = {"type": "object", "required": list(required), "properties": parts}
    content = {"multipart/form-data": {"schema": schema}}
    return {"requestBody": {"required": True, "content": content}}
