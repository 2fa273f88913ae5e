"""Task: check a ROS map_server map that somebody uploads, and prepare its source folder.

Arguments: `yaml`, `image` (paths), `out` (folder). Result: rows, columns and resolution.
The `image` entry of the file is not followed: the uploaded image is what is read.
"""

from __future__ import annotations

from pathlib import Path

import yaml

from app.jobs.tasks import Arguments, Result
from app.storage.map_source import MAP_YAML, image_file
from core.errors import MapError
from core.log_readers.limits import DEFAULT_LIMITS
from core.log_readers.safe_yaml import load_yaml
from core.mapping.map_server import read_map
from core.progress import Progress


def run(arguments: Arguments, progress: Progress) -> Result:
    """Reads the map."""
    given, image = Path(arguments["yaml"]), Path(arguments["image"])
    out = Path(arguments["out"])
    table = load_yaml(given.read_bytes(), given.name, DEFAULT_LIMITS)
    if not isinstance(table, dict):
        raise MapError(f"{given.name}: a map.yaml is a table with image, resolution and origin")
    out.mkdir()
    stored = out / image_file(image)
    image.rename(stored)
    (out / MAP_YAML).write_text(yaml.safe_dump(table | {"image": stored.name}), encoding="utf-8")
    grid = read_map(out / MAP_YAML)
    rows, columns = grid.geometry.shape
    return {"rows": rows, "columns": columns, "resolution": grid.geometry.resolution}
