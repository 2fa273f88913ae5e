from __future__ import annotations

import math

import pytest

from core.sensing import RING_PRESETS, Sonar, SonarRing
from core.sensing.ring import circle


@pytest.mark.parametrize("count", [1, 8, 12, 16])
def test_sonars_of_a_circle_look_outwards_from_it(count: int) -> None:
    ring = circle(count, radius=0.3)
    assert len(ring) == count
    for i, sonar in enumerate(ring.sonars):
        assert math.hypot(sonar.x, sonar.y) == pytest.approx(0.3, abs=1e-5)
        assert math.atan2(sonar.y, sonar.x) == pytest.approx(sonar.heading, abs=1e-4)
        turn = sonar.heading - 2 * math.pi * i / count
        assert math.remainder(turn, 2 * math.pi) == pytest.approx(0, abs=1e-9)


def test_the_paper_has_twelve_sonars_every_thirty_degrees_on_a_circle_of_twenty_centimetres() -> (
    None
):
    left = RING_PRESETS["paper-12"].sonars[3]
    assert left == Sonar(
        0.0, 0.2, pytest.approx(math.pi / 2), pytest.approx(math.radians(50)), 0.1, 4.0
    )


def test_a_pioneer_has_its_sonars_clockwise_from_the_left() -> None:
    front = RING_PRESETS["p3dx-front-8"].sonars
    both = RING_PRESETS["p3dx-16"].sonars
    assert both[:8] == front
    assert [round(math.degrees(sonar.heading)) for sonar in both] == (
        [90, 50, 30, 10, -10, -30, -50, -90, -90, -130, -150, -170, 170, 150, 130, 90]
    )
    assert [(sonar.x, sonar.y) for sonar in both[7:10]] == (
        [(0.069, -0.136), (-0.157, -0.136), (-0.203, -0.119)]
    )


def test_reach_counts_from_the_robot_centre() -> None:
    ring = SonarRing((Sonar(0.3, 0.4, 0, 1, 0.1, 2.0), Sonar(0, 0, 0, 1, 0.1, 2.2)), 0.2)
    assert ring.max_range == 2.2
    assert ring.reach == pytest.approx(2.5)
