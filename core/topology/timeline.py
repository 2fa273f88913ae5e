"""The timeline of a model: what its history tells, step by step, and the pictures that belong to it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from core.errors import ModelError
from core.mapping import GridGeometry
from core.segmentation.step_picture import StepPicture


def moments(history: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """The steps of a history in order, each with its decisions; edits are left out."""
    found: list[dict[str, Any]] = []
    for entry in history:
        if entry.get("event") == "step":
            found.append({**entry, "decisions": []})
        elif found and entry.get("event") == "extract":
            found[-1]["decisions"].append(dict(entry))
    return found


def picture_on_map(png: bytes, moment: Mapping[str, Any], geometry: GridGeometry) -> StepPicture:
    """The picture of a step on the grid of the model, cell by cell.

    Args:
        png: the picture as it is stored.
        moment: the entry of the history for that step.
        geometry: of the model's grid.

    Raises:
        ModelError: the picture does not fit the grid.
    """
    try:
        place = moment["picture"]
        origin = np.array([float(place["origin"][axis]) for axis in (0, 1)])
        resolution = float(place["resolution"])
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise ModelError("history.jsonl: a step does not tell where its picture lies") from error
    offset = (origin - np.array(geometry.origin[:2])) / geometry.resolution
    if not np.isfinite(offset).all() or not np.isclose(resolution, geometry.resolution):
        raise ModelError("history.jsonl: the picture of a step does not fit the map")
    column, row = np.rint(offset).astype(int)
    picture = _renumbered(StepPicture.read(png), place.get("numbers", {}))
    return picture.placed((int(row), int(column)), geometry.shape)


def _renumbered(picture: StepPicture, numbers: Mapping[str, int]) -> StepPicture:
    """The picture with the numbers that its regions have now."""
    table = np.arange(int(picture.regions.max(initial=0)) + 1)
    for drawn, number in numbers.items():
        if int(drawn) < len(table):
            table[int(drawn)] = number
    return replace(picture, regions=table[picture.regions])
