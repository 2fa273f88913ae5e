from __future__ import annotations

from app.viewer.camera import View
from app.viewer.camera_link import ECHO_S, CameraLink


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


def view(x: float) -> View:
    return View((x, 0.0, 10.0), (x, 1.0, 0.0), (0.0, 0.0, 1.0), 0.7)


def linked() -> tuple[Clock, CameraLink, list[View], CameraLink, list[View]]:
    clock, left, right = Clock(), [], []
    one, two = CameraLink(left.append, clock), CameraLink(right.append, clock)
    one.join(two)
    return clock, one, left, two, right


def test_the_other_camera_follows() -> None:
    _, one, left, _, right = linked()
    one.moved(view(3.0))
    assert (left, right) == ([], [view(3.0)])


def test_what_the_follower_tells_on_its_way_does_not_pull_the_first_back() -> None:
    clock, one, left, two, _ = linked()
    one.moved(view(3.0))
    two.moved(view(1.5))
    clock.now += ECHO_S + 0.1
    two.moved(view(3.0))
    assert left == []


def test_both_sides_can_lead() -> None:
    clock, one, left, two, _ = linked()
    one.moved(view(3.0))
    clock.now += ECHO_S + 0.1
    two.moved(view(8.0))
    assert left == [view(8.0)]


def test_cameras_that_were_parted_stay_where_they_are() -> None:
    _, one, _, two, right = linked()
    two.join(None)
    one.moved(view(3.0))
    assert right == []
