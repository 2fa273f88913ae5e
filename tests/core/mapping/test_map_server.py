from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from core.errors import MapError, TooLargeError
from core.mapping import FREE, OCCUPIED, GridGeometry, OccupancyGrid
from core.mapping.map_server import read_map, write_map


@pytest.fixture
def grid() -> OccupancyGrid:
    state = np.array([[0, 1, 2], [1, 1, 0]], np.uint8)
    return OccupancyGrid(GridGeometry(0.05, (-1.25, 0.5, 0.0), (2, 3)), state)


def test_a_written_map_reads_back_the_same(grid: OccupancyGrid, tmp_path: Path) -> None:
    write_map(grid, tmp_path)
    back = read_map(tmp_path / "map.yaml")
    np.testing.assert_array_equal(back.state, grid.state)
    assert back.geometry == grid.geometry


def test_the_image_has_the_highest_y_at_the_top(grid: OccupancyGrid, tmp_path: Path) -> None:
    write_map(grid, tmp_path)
    with Image.open(tmp_path / "map.pgm") as image:
        assert np.asarray(image).tolist() == [[254, 254, 205], [205, 254, 0]]


def test_a_negated_png_map_is_understood(tmp_path: Path) -> None:
    Image.fromarray(np.array([[255, 0]], np.uint8)).save(tmp_path / "m.png")
    (tmp_path / "m.yaml").write_text(
        "image: m.png\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 1\n"
    )
    assert read_map(tmp_path / "m.yaml").state.tolist() == [[OCCUPIED, FREE]]


@pytest.mark.parametrize(
    ("yaml", "complaint"),
    [
        ("image: m.png\norigin: [0, 0, 0]\n", "resolution"),
        ("image: m.png\nresolution: -1\norigin: [0, 0, 0]\n", "resolution"),
        ("image: m.png\nresolution: .nan\norigin: [0, 0, 0]\n", "resolution"),
        ("image: gone.png\nresolution: 1\norigin: [0, 0, 0]\n", "gone.png"),
        ("image: [1\n", "YAML"),
        ("image: m.yaml\nresolution: 1\norigin: [0, 0, 0]\n", "no picture"),
    ],
)
def test_a_broken_map_is_named(tmp_path: Path, yaml: str, complaint: str) -> None:
    (tmp_path / "m.yaml").write_text(yaml)
    with pytest.raises(MapError, match=complaint):
        read_map(tmp_path / "m.yaml")


def test_a_map_of_16_bits_without_white_keeps_its_unknown_cells(tmp_path: Path) -> None:
    Image.fromarray(np.array([[254, 205, 0]], np.uint16) * 257).save(tmp_path / "m.png")
    (tmp_path / "m.yaml").write_text("image: m.png\nresolution: 0.1\norigin: [0, 0, 0]\n")
    assert read_map(tmp_path / "m.yaml").state.tolist() == [[FREE, 0, OCCUPIED]]


def test_a_picture_that_is_far_too_large_is_told_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    Image.fromarray(np.zeros((1, 3), np.uint8)).save(tmp_path / "m.png")
    (tmp_path / "m.yaml").write_text("image: m.png\nresolution: 0.1\norigin: [0, 0, 0]\n")
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 1)
    with pytest.raises(TooLargeError, match="scale it down"):
        read_map(tmp_path / "m.yaml")
