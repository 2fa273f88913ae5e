"""The source of a model that was imported: `map.yaml` and its image in a folder of their own."""

from __future__ import annotations

from pathlib import Path

MAP_YAML = "map.yaml"
IMAGE_SUFFIXES = (".pgm", ".png")


def image_file(uploaded: Path) -> str:
    """The image's name in the folder: its suffix tells programs what it is, its own name nothing."""
    suffix = uploaded.suffix.lower()
    return f"map{suffix if suffix in IMAGE_SUFFIXES else '.image'}"
