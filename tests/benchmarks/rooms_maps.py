"""Rooms found on maps with ground truth, one default for all: the table of the README.

    python tests/benchmarks/rooms_maps.py --data SHARED [--out FOLDER]

SHARED/rooms holds `index.csv` and `maps/NAME.png`, `maps/NAME_gt.png` (255 free, 205 unknown, 0
occupied; room numbers). `--out` writes the rooms as images of the same size, one for each map.
"""

from __future__ import annotations

import argparse
import csv
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from core.evaluation.room_metrics import room_metrics
from core.geometry import IntArray
from core.mapping import GridGeometry, OccupancyGrid
from core.segmentation.automatic import segment_automatically

GROUPS = ("home_slam", "home_vacuum", "real_cluttered", "ipa_furnished", "ipa_empty")
FREE_FROM, OCCUPIED_BELOW = 250, 50
COLUMNS = ("f1", "pq", "ari", "over", "under")


@dataclass(frozen=True)
class MapOfRooms:
    """A map with its true rooms (row 0 = lowest y, like the grid)."""

    name: str
    group: str
    building: str
    grid: OccupancyGrid
    truth: IntArray


def load_maps(data: Path) -> list[MapOfRooms]:
    """All maps of a data folder."""
    folder = data / "rooms"
    with (folder / "index.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    maps = []
    for row in rows:
        image = _image(folder / "maps" / f"{row['name']}.png")
        truth = _image(folder / "maps" / f"{row['name']}_gt.png")
        geometry = GridGeometry(float(row["resolution"]), (0.0, 0.0, 0.0), image.shape)
        grid = OccupancyGrid.of(geometry, image >= FREE_FROM, image < OCCUPIED_BELOW)
        maps.append(MapOfRooms(row["name"], row["group"], row["base"], grid, truth))
    return maps


def _image(path: Path) -> IntArray:
    pixels = np.asarray(Image.open(path)).astype(np.int64)
    return np.ascontiguousarray((pixels[..., 0] if pixels.ndim == 3 else pixels)[::-1])


def scored(entry: MapOfRooms, rooms: IntArray) -> dict[str, float]:
    """The metrics of rooms found on a map."""
    return {
        k: float(v) for k, v in asdict(room_metrics(rooms, entry.truth, entry.grid.free)).items()
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    maps = load_maps(options.data)
    segment_automatically(maps[0].grid)  # compiles
    scores: dict[str, list[dict[str, float]]] = {group: [] for group in GROUPS}
    for entry in maps:
        start = time.perf_counter()
        found = segment_automatically(entry.grid)
        score = scored(entry, found.rooms) | {"s": time.perf_counter() - start}
        score["nodes"] = float(found.regions.max())
        scores[entry.group].append(score)
        sys.stdout.write(
            f"{entry.name:34s} pq {score['pq']:.2f}  f1 {score['f1']:.2f}  rooms "
            f"{score['rooms']:.0f} found {score['segments']:.0f}  nodes {score['nodes']:.0f}  "
            f"{score['s']:.1f} s\n"
        )
        sys.stdout.flush()
        if options.out:
            options.out.mkdir(parents=True, exist_ok=True)
            picture = Image.fromarray(found.rooms[::-1].astype(np.uint16))
            picture.save(options.out / f"{entry.name}.png")
    for group, mine in [*scores.items(), ("all", [s for g in scores.values() for s in g])]:
        means = "  ".join(f"{k} {np.mean([s[k] for s in mine]):.3f}" for k in COLUMNS)
        seconds = [s["s"] for s in mine]
        sys.stdout.write(
            f"{group:16s} {means}  s {np.median(seconds):.2f} median {max(seconds):.2f} most\n"
        )


if __name__ == "__main__":
    main()
