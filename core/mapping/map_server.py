"""Maps as ROS map_server reads and writes them: map.yaml beside an image."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from PIL import Image, UnidentifiedImageError
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from core.errors import LogError, MapError, TooLargeError
from core.geometry import FloatArray
from core.log_readers.limits import ReadLimits
from core.log_readers.safe_yaml import describe, load_yaml
from core.mapping.map_result import MAX_CELLS
from core.mapping.occupancy_grid import FREE, OCCUPIED, GridGeometry, OccupancyGrid

BRIGHTEST_16_BIT = 65535
"""Pillow scales pictures of more than 8 bits to this, whatever their own maximum is."""
PIXEL_FREE, PIXEL_UNKNOWN, PIXEL_OCCUPIED = 254, 205, 0
OCCUPIED_THRESHOLD, FREE_THRESHOLD = 0.65, 0.196


class MapHeader(BaseModel):
    """What map.yaml says (metres, radians)."""

    model_config = ConfigDict(allow_inf_nan=False)

    image: str = Field(min_length=1, max_length=255)
    resolution: float = Field(gt=1e-4, le=10)
    origin: tuple[float, float, float]
    negate: bool = False
    occupied_thresh: float = Field(OCCUPIED_THRESHOLD, ge=0, le=1)
    free_thresh: float = Field(FREE_THRESHOLD, ge=0, le=1)
    mode: Literal["trinary", "scale", "raw"] = "trinary"


def write_map(grid: OccupancyGrid, folder: Path) -> None:
    """Writes `map.pgm` (trinary, row 0 at the top) and `map.yaml` into a folder that exists."""
    rows, cols = grid.geometry.shape
    data = f"P5\n{cols} {rows}\n255\n".encode() + trinary(grid).tobytes()
    (folder / "map.pgm").write_bytes(data)
    x, y, heading = grid.geometry.origin
    (folder / "map.yaml").write_text(
        "image: map.pgm\nmode: trinary\n"
        f"resolution: {grid.geometry.resolution:.10g}\n"
        f"origin: [{x:.6f}, {y:.6f}, {heading:.6f}]\n"
        f"negate: 0\noccupied_thresh: {OCCUPIED_THRESHOLD}\nfree_thresh: {FREE_THRESHOLD}\n",
        encoding="utf-8",
    )


def trinary(grid: OccupancyGrid) -> npt.NDArray[np.uint8]:
    """The pixels (rows, cols) of the map's image, row 0 at the top."""
    pixels = np.full(grid.state.shape, PIXEL_UNKNOWN, np.uint8)
    pixels[grid.state == FREE] = PIXEL_FREE
    pixels[grid.state == OCCUPIED] = PIXEL_OCCUPIED
    return pixels[::-1]


def read_map(yaml_path: Path, image_path: Path | None = None) -> OccupancyGrid:
    """Reads a map.

    Args:
        yaml_path: `map.yaml`.
        image_path: its image; by default the one that it names, beside it.

    Raises:
        MapError: a file is missing or is not what it should be.
        TooLargeError: more cells than a grid may have.
    """
    header = _header(yaml_path)
    path = image_path or yaml_path.parent / header.image
    brightness = _brightness(path)
    occupancy = brightness if header.negate else 1 - brightness
    if header.mode == "raw":
        occupancy = np.where(brightness * 255 <= 100, brightness * 2.55, 0.5 * (1 + FREE_THRESHOLD))
    rows, cols = occupancy.shape
    state = np.zeros((rows, cols), np.uint8)
    state[occupancy < header.free_thresh] = FREE
    state[occupancy > header.occupied_thresh] = OCCUPIED
    x, y, heading = header.origin
    origin = (x, y, math.remainder(heading, 2 * math.pi))
    geometry = GridGeometry(header.resolution, origin, (rows, cols))
    return OccupancyGrid(geometry, np.ascontiguousarray(state[::-1]))


def _header(path: Path) -> MapHeader:
    try:
        content: Any = load_yaml(path.read_bytes(), path.name, ReadLimits())
        return MapHeader.model_validate(content)
    except OSError as error:
        raise MapError(f"{path.name}: {error.strerror}") from error
    except LogError as error:
        raise MapError(str(error)) from error
    except ValidationError as error:
        raise MapError(f"{path.name}: {describe(error)}") from error


def _brightness(path: Path) -> FloatArray:
    """Brightness 0..1 of an image, row 0 at the top; transparent counts as unknown."""
    try:
        with Image.open(path) as image:
            if image.width * image.height > MAX_CELLS:
                raise TooLargeError(
                    f"{path.name}: {image.width} x {image.height} pixels; at most {MAX_CELLS} "
                    "are read; scale it down and raise the resolution in map.yaml"
                )
            if image.mode in ("RGBA", "LA", "P"):
                return _over_unknown(image)
            if image.mode.startswith("I"):
                return np.asarray(image, float) / BRIGHTEST_16_BIT
            if image.mode == "F":
                values = np.asarray(image, float)
                return np.asarray(values / max(float(values.max()), 1.0))
            return np.asarray(image.convert("L"), float) / 255
    except OSError as error:
        what = "is no picture" if isinstance(error, UnidentifiedImageError) else str(error)
        raise MapError(f"{path.name}: {error.strerror or what}") from error
    except Image.DecompressionBombError as error:
        raise TooLargeError(
            f"{path.name}: more than {2 * (Image.MAX_IMAGE_PIXELS or 0)} pixels; at most {MAX_CELLS} "
            "are read; scale it down and raise the resolution in map.yaml"
        ) from error
    except (ValueError, SyntaxError) as error:
        raise MapError(f"{path.name}: {error}") from error


def _over_unknown(image: Image.Image) -> FloatArray:
    """A picture with transparency over the grey of unknown cells."""
    picture = np.asarray(image.convert("RGBA"), float)
    grey = picture[..., :3].mean(axis=2)
    return np.asarray(np.where(picture[..., 3] > 127, grey, PIXEL_UNKNOWN) / 255)
