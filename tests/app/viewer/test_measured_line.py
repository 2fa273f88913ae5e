"""Two clicks on the floor make a distance."""

from __future__ import annotations

from app.viewer.measured_line import MeasuredLine


def test_two_clicks_make_a_distance_and_a_third_begins_anew() -> None:
    line = MeasuredLine()
    line.add((1.0, 1.0))
    assert line.distance_m is None
    line.add((4.0, 5.0))
    assert line.distance_m == 5.0
    line.add((0.0, 0.0))
    assert line.points == ((0.0, 0.0),)
    assert line.distance_m is None
