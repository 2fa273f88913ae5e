"""A model folder in forms that a browser takes."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

from PIL import Image

MAP_IMAGE = "map.pgm"


def grid_png(model_folder: Path) -> bytes:
    """The map's image; in the folder it is a PGM, which browsers do not show."""
    buffer = io.BytesIO()
    with Image.open(model_folder / MAP_IMAGE) as image:
        image.save(buffer, "PNG")
    return buffer.getvalue()


def zipped(model_folder: Path) -> bytes:
    """All files of the folder in one archive."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(model_folder.iterdir()):
            archive.write(path, path.name)
    return buffer.getvalue()
