"""What a step of extraction looked like, as one small picture that any program reads.

A PNG of 8-bit red, green and blue, row 0 at the top (north):

- red: `state + 4 * cluster`; state 0 unknown, 1 free, 2 occupied; cluster 1..63 is the tentative
  part of that number, 0 none (parts beyond the 63rd share that number);
- green and blue: `256 * green + blue` is the number of the extracted region, 0 none.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
import numpy.typing as npt
from PIL import Image

from core.errors import ModelError
from core.geometry import IntArray

Layer = TypeVar("Layer", IntArray, npt.NDArray[np.uint8])
MOST_CLUSTERS = 63
STATES = 4
MOST_PIXELS = 30_000_000
"""Of a picture that is read: a grid has at most 25 million cells."""


@dataclass(frozen=True)
class StepPicture:
    """Layers (rows, cols), row 0 at the bottom like a grid.

    Attributes:
        state: UNKNOWN, FREE or OCCUPIED, the map at that moment.
        clusters: tentative parts by number, 0 = none.
        regions: extracted regions by number, 0 = none.
    """

    state: npt.NDArray[np.uint8]
    clusters: IntArray
    regions: IntArray

    def png(self) -> bytes:
        """The picture as a file."""
        clusters = np.minimum(self.clusters, MOST_CLUSTERS)
        layers = (self.state + STATES * clusters, self.regions // 256, self.regions % 256)
        pixels = np.stack(layers, axis=-1).astype(np.uint8)
        file = io.BytesIO()
        Image.fromarray(np.ascontiguousarray(pixels[::-1])).save(file, "PNG", compress_level=3)
        return file.getvalue()

    @classmethod
    def read(cls, png: bytes) -> StepPicture:
        """Reads what `png` made.

        Raises:
            ModelError: it is no such picture.
        """
        try:
            with Image.open(io.BytesIO(png), formats=["PNG"]) as image:
                if image.mode != "RGB" or image.width * image.height > MOST_PIXELS:
                    raise ModelError("the picture of a step is no RGB picture of a grid")
                pixels = np.asarray(image)[::-1].astype(np.int64)
        except OSError as error:
            raise ModelError("the picture of a step cannot be read") from error
        state, clusters = pixels[..., 0] % STATES, pixels[..., 0] // STATES
        return cls(state.astype(np.uint8), clusters, 256 * pixels[..., 1] + pixels[..., 2])

    def placed(self, corner: tuple[int, int], shape: tuple[int, int]) -> StepPicture:
        """The layers in a grid of another shape, whose cell `corner` is this one's cell [0, 0]."""
        return StepPicture(
            _placed(self.state, corner, shape),
            _placed(self.clusters, corner, shape),
            _placed(self.regions, corner, shape),
        )


def _placed(layer: Layer, corner: tuple[int, int], shape: tuple[int, int]) -> Layer:
    out = np.zeros(shape, layer.dtype)
    low = np.maximum(corner, 0)
    high = np.minimum(np.add(corner, layer.shape), shape)
    if (high > low).all():
        mine = tuple(slice(a - c, b - c) for a, b, c in zip(low, high, corner, strict=True))
        out[low[0] : high[0], low[1] : high[1]] = layer[mine]
    return out
