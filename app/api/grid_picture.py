"""The grid of a model folder as a PNG."""

from __future__ import annotations

import io
from pathlib import Path

from PIL import Image

MAP_IMAGE = "map.pgm"


def grid_png(model_folder: Path) -> bytes:
    """The map's image; in the folder it is a PGM, which browsers do not show."""
    with Image.open(model_folder / MAP_IMAGE) as image:
        buffer = io.BytesIO()
        image.save(buffer, "PNG")
    return buffer.getvalue()
