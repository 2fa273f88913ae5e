from __future__ import annotations

import math
from pathlib import Path

import pytest

from core.errors import InputError, LogError, TooLargeError
from core.log_readers.ring_file import load_ring, parse_ring, table_of, write_ring
from core.sensing import RING_PRESETS, Sonar


@pytest.mark.parametrize("name", RING_PRESETS)
def test_a_preset_is_loaded_by_name_and_survives_a_file(name: str, tmp_path: Path) -> None:
    ring = load_ring(name)
    assert ring is RING_PRESETS[name]
    write_ring(ring, tmp_path / "ring.json")
    assert load_ring(str(tmp_path / "ring.json")) == ring


def test_units_shared_fields_and_rows(tmp_path: Path) -> None:
    (tmp_path / "ring.yaml").write_text(
        """
        robot: {radius: 260}
        units: {length: mm, angle: deg}
        beam_width: 30
        min_range: 100
        max_range: 5000
        sonars:
          - [69, 136, 90]
          - {x: 0, y: -1, heading: -90, beam_width: 20}
        """,
        encoding="utf-8",
    )
    ring = load_ring(str(tmp_path / "ring.yaml"))
    quarter = math.pi / 2
    assert ring.robot_radius == pytest.approx(0.26)
    first, second = (list(vars(sonar).values()) for sonar in ring.sonars)
    assert first == pytest.approx([0.069, 0.136, quarter, math.pi / 6, 0.1, 5.0])
    assert second == pytest.approx([0.0, -0.001, -quarter, math.pi / 9, 0.1, 5.0])


def test_neither_preset_nor_file_names_the_presets() -> None:
    with pytest.raises(InputError, match=r"'paper-13' is neither a file nor one of paper-12"):
        load_ring("paper-13")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "a ring is a table"),
        ("sonars: 5", "robot: Field required"),
        ("{robot: {radius: .2}, sonars: [5]}", r"sonars\[0\]"),
        ("{robot: {radius: .2}, sonars: [[0, 0]]}", r"sonars\[0\].heading: Field required"),
        ("{robot: {radius: .nan}, sonars: [[0, 0, 0]]}", "finite number"),
        (
            "{robot: {radius: .2}, sonars: [[9, 0, 0]], beam_width: 1, min_range: 0, max_range: 1}",
            "9 m",
        ),
        (
            "{robot: {radius: .2}, sonars: [[0, 0, 90]], beam_width: 1, min_range: 0, max_range: 1}",
            "angle",
        ),
        (
            "{robot: {radius: .2}, sonars: [[0, 0, 0]], beam_width: 30, min_range: 0, max_range: 1}",
            "2 pi",
        ),
        ("a: [", "no valid YAML"),
    ],
)
def test_a_wrong_ring_file_is_one_error_with_its_name(
    text: str, message: str, tmp_path: Path
) -> None:
    path = tmp_path / "ring.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(LogError, match=rf"ring.yaml.*{message}"):
        load_ring(str(path))


def test_a_ring_has_at_most_256_sonars() -> None:
    table = table_of(RING_PRESETS["circle-8"])
    sonar = table["sonars"][0]
    assert len(parse_ring(table | {"sonars": [sonar] * 256})) == 256
    with pytest.raises(TooLargeError, match="257 sonars"):
        parse_ring(table | {"sonars": [sonar] * 257})


def test_presets_are_the_rings_they_say() -> None:
    paper = RING_PRESETS["paper-12"].sonars
    assert len(paper) == 12
    assert paper[3] == Sonar(0.0, 0.2, pytest.approx(math.pi / 2), math.radians(50), 0.1, 4.0)
    pioneer = RING_PRESETS["p3dx-16"].sonars
    assert [round(math.degrees(s.heading)) for s in pioneer] == (
        [90, 50, 30, 10, -10, -30, -50, -90, -90, -130, -150, -170, 170, 150, 130, 90]
    )
