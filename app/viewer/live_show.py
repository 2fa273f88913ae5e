"""The live session as one tab shows it: now or a moment before, drawn or paused, followed or not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.viewer.beam_shapes import BeamPlan, plan_beams
from app.viewer.camera import View
from app.viewer.drawing import Drawing
from app.viewer.live_scene import FADES
from app.viewer.live_track import LiveTrack
from app.viewer.messages import Live
from app.viewer.tab_scene import TabScene
from core.geometry import FloatArray

FOLLOWED_REACH = 3.2
"""Metres from the middle of the picture to its upper rim at most, as a robot begins to be followed."""
FOLLOWED_FROM = np.deg2rad(72.0)
"""Elevation from which it is seen at least then: walls hide it from eyes further down."""
AROUND_ROBOT, BESIDE_ROBOT = 3.5, 0.6
"""Metres around it that are in the picture before there is a map, and later."""
_CORNERS = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])


class LiveShow:
    """What a tab shows of a session; it outlives a lost view. Event loop's thread only.

    Attributes:
        follow: the camera goes with the robot.
        paused: nothing is drawn until it is not; the session goes on.
        at: the moment that is shown (s); None: now.
    """

    def __init__(self) -> None:
        self.follow = False
        self.paused = False
        self.at: float | None = None
        self._shown = -1
        self._follows = False

    def told(self, message: Live) -> None:
        """How the page wants it."""
        self._follows = self._follows and message.follow
        self.follow, self.paused, self.at = message.follow, message.paused, message.at

    def draw(self, track: LiveTrack, scene: TabScene, anew: bool = False) -> None:
        """Draws the moment; `anew`: not what comes right after what is drawn."""
        if not len(track) or (self.paused and not anew):
            return
        index = track.index_at(self.at)
        if index == self._shown and not anew:
            return
        anew = anew or index < self._shown
        self._shown = index
        pose = track.pose(index)
        scene.belief.show_robot(scene.drawing, None if pose is None else pose.tolist())
        scene.live.show_pin(pose)
        scene.live.show_way(track.path(index), anew or track.localizes)
        first = max(0, index - len(FADES) + 1)
        plans = [plan for plan in (_plan(track, i) for i in range(first, index + 1)) if plan]
        scene.live.show_beams(plans)
        if plans and self.at is None and not track.localizes:
            scene.live.add_dots(plans[-1])

    @property
    def drawn(self) -> bool:
        """Whether anything of the session is drawn."""
        return self._shown >= 0

    def outline(self, track: LiveTrack, drawing: Drawing) -> FloatArray:
        """(K, 2) what a camera shows: the map, and the robot with a little around it."""
        pose = track.pose(track.index_at(self.at)) if len(track) else None
        if pose is None:
            return drawing.outline
        if not drawing.display.floor.any():
            return pose[:2] + AROUND_ROBOT * _CORNERS
        return np.concatenate((drawing.outline, pose[:2] + BESIDE_ROBOT * _CORNERS))

    def camera(self, track: LiveTrack, view: View) -> View | None:
        """Where a camera that follows goes from `view`; None: it stays."""
        if not self.follow or self.paused or not len(track):
            return None
        pose = track.pose(track.index_at(self.at))
        if pose is None:
            return None
        if not self._follows:
            view = _over_walls(view)
        self._follows = True
        return _centred(view, pose)


def _plan(track: LiveTrack, index: int) -> BeamPlan | None:
    pose = track.pose(index)
    return None if pose is None else plan_beams(track.ring, pose, track.ranges(index))


def _over_walls(view: View) -> View:
    """A view from the same side, nearer and from higher up, as far as it is not already."""
    offset = np.subtract(view.position, view.look_at)
    distance = float(np.linalg.norm(offset))
    elevation = max(float(np.arcsin(offset[2] / distance)), FOLLOWED_FROM)
    azimuth = float(np.arctan2(offset[1], offset[0]))
    reach = min(distance, FOLLOWED_REACH / float(np.tan(view.fov / 2)))
    level = reach * np.cos(elevation)
    moved = (level * np.cos(azimuth), level * np.sin(azimuth), reach * np.sin(elevation))
    return replace(view, position=_triple(np.add(view.look_at, moved)))


def _centred(view: View, pose: FloatArray) -> View:
    """The view with the robot in its middle."""
    middle = np.array([pose[0], pose[1], 0.0])
    offset = np.subtract(view.position, view.look_at)
    return replace(view, position=_triple(middle + offset), look_at=_triple(middle))


def _triple(values: FloatArray) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return (x, y, z)
