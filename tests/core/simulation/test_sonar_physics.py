"""What a sonar hears: walls met squarely and at a glance, corners, edges, faults."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from core.geometry import FloatArray
from core.sensing import Sonar, SonarRing
from core.simulation.floor_plan import Box, Room
from core.simulation.furniture import Piece, piece
from core.simulation.home import Home
from core.simulation.outline import Outline, outline_of
from core.simulation.sonar_model import SonarModel
from core.simulation.sonar_physics import SonarPhysics

IDEAL = SonarModel(
    threshold_spread=0.0,
    noise=0.0,
    noise_per_metre=0.0,
    lateness=0.0,
    dropouts=0.0,
    outliers=0.0,
    crosstalk=0.0,
)
ROOM = Room("room", "room", (Box(0, 0, 8, 6),))
"""Its walls' faces are at x = 0.1 and 7.9, y = 0.1 and 5.9."""


def sonar(beam_deg: float = 50.0, max_range: float = 5.0) -> SonarRing:
    return SonarRing((Sonar(0.0, 0.0, 0.0, math.radians(beam_deg), 0.1, max_range),), 0.2)


def smooth(*pieces: Piece) -> Outline:
    """A room of plain plaster only, without radiators and frames."""
    o = outline_of(Home("room", (ROOM,), (), pieces))
    plain = np.array([0.16, 0.95, 0.01])
    return replace(o, surfaces=np.tile(plain, (len(o.faces), 1)))


def read(
    pose: tuple[float, float, float],
    ring: SonarRing,
    *pieces: Piece,
    model: SonarModel = IDEAL,
    seed: int = 0,
) -> FloatArray:
    physics = SonarPhysics(smooth(*pieces), ring, model)
    return physics.scan(np.array(pose), np.random.default_rng(seed))


@pytest.mark.parametrize("distance", [0.4, 1.0, 2.5, 4.5])
def test_a_wall_met_squarely_is_read_at_its_distance(distance: float) -> None:
    assert read((7.9 - distance, 3.0, 0.0), sonar())[0] == pytest.approx(distance, abs=0.011)


def test_a_wide_beam_reads_the_perpendicular_not_the_axis() -> None:
    reading = read((6.4, 3.0, math.radians(20)), sonar())[0]
    assert reading == pytest.approx(1.5, abs=0.02)
    assert reading < 1.5 / math.cos(math.radians(20)) - 0.05


def test_a_narrow_beam_loses_a_wall_that_it_meets_at_a_glance() -> None:
    on_axis = 1.5 / math.cos(math.radians(50))
    reading = read((6.4, 3.0, math.radians(50)), sonar(15.0))[0]
    assert math.isnan(reading) or reading > on_axis + 0.5


def test_a_corner_of_two_walls_answers_from_its_own_distance() -> None:
    x, y = 7.9 - 1.5, 5.9 - 1.5
    reading = read((x, y, math.radians(45)), sonar(15.0))[0]
    assert reading == pytest.approx(1.5 * math.sqrt(2), abs=0.06)


def test_an_edge_is_heard_although_no_face_looks_at_the_sonar() -> None:
    chest = piece("chest", Box(4.0, 3.0, 5.0, 4.0))
    corner = np.array([4.0, 3.0])
    at = corner - 0.8 * np.array([math.cos(math.pi / 4), math.sin(math.pi / 4)])
    pose = (float(at[0]), float(at[1]), math.pi / 4)
    assert read(pose, sonar(15.0), chest)[0] == pytest.approx(0.8, abs=0.02)


def test_nothing_is_heard_beyond_the_maximum_range() -> None:
    assert math.isnan(read((3.5, 3.0, 0.0), sonar(20.0, max_range=2.0))[0])


def test_what_is_too_near_reads_the_minimum_range() -> None:
    assert read((7.87, 3.0, 0.0), sonar())[0] == pytest.approx(0.1)


def test_a_solid_thing_hides_the_wall_behind_it() -> None:
    chest = piece("chest", Box(6.0, 2.0, 6.5, 4.0))
    assert read((5.0, 3.0, 0.0), sonar(), chest)[0] == pytest.approx(1.0, abs=0.011)


def test_faults_come_as_often_as_the_model_says() -> None:
    model = replace(IDEAL, dropouts=0.1, outliers=0.05, crosstalk=0.2)
    physics = SonarPhysics(smooth(), sonar(), model)
    rng = np.random.default_rng(1)
    readings = np.array([physics.scan(np.array([4.9, 3.0, 0.0]), rng)[0] for _ in range(3000)])
    assert np.isnan(readings).mean() == pytest.approx(0.1, abs=0.02)
    assert (readings > 3.1).mean() == pytest.approx(0.05 * 1.9 / 4.9, abs=0.012)
    assert (readings < 2.9).mean() == pytest.approx(0.2 + 0.05 * 2.8 / 4.9, abs=0.03)


def test_noise_has_the_given_spread() -> None:
    model = replace(IDEAL, noise=0.02, noise_per_metre=0.01, step=0.001)
    physics = SonarPhysics(smooth(), sonar(), model)
    rng = np.random.default_rng(2)
    readings = np.array([physics.scan(np.array([4.9, 3.0, 0.0]), rng)[0] for _ in range(2000)])
    assert readings.std() == pytest.approx(0.05, rel=0.1)
    assert readings.mean() == pytest.approx(3.0, abs=0.01)


def test_ranges_are_whole_centimetres() -> None:
    ring = SonarRing(
        tuple(Sonar(0, 0, a, math.radians(50), 0.1, 5.0) for a in np.linspace(-3, 3, 13)), 0.2
    )
    readings = read((3.3, 2.7, 0.4), ring, model=SonarModel())
    heard = readings[np.isfinite(readings)]
    assert len(heard) > 6
    assert np.allclose(heard * 100, np.round(heard * 100))


def test_the_same_generator_gives_the_same_scan() -> None:
    ring = sonar()
    one = read((3.0, 3.0, 1.0), ring, model=SonarModel(), seed=5)
    two = read((3.0, 3.0, 1.0), ring, model=SonarModel(), seed=5)
    assert np.array_equal(one, two, equal_nan=True)
