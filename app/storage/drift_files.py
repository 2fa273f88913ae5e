"""What a model folder tells of the drift of its drive."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from app.storage.model_facts import read_json
from core.mapping.drift_edits import DriftEdits
from core.mapping.drift_view import DRIFT_FILE

EDITS_JSON: TypeAdapter[DriftEdits] = TypeAdapter(DriftEdits)
PROVENANCE_FILE = "provenance.json"


def drift_edits(model_folder: Path) -> DriftEdits:
    """What a person said about it; nothing when the folder does not tell."""
    try:
        return EDITS_JSON.validate_python(read_json(model_folder / DRIFT_FILE)["edits"])
    except FileNotFoundError:
        return DriftEdits()


def drift_report(model_folder: Path) -> dict[str, Any] | None:
    """What was found, what was said, and the drive before and after; None without a drive."""
    try:
        kept = read_json(model_folder / DRIFT_FILE)
    except FileNotFoundError:
        return None
    found: dict[str, Any] = read_json(model_folder / PROVENANCE_FILE)["odometry"]
    return kept | found
